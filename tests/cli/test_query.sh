#!/usr/bin/env bash
# hrad query: the tables it prints, where sensors stand, and that they agree with each other.
. "$(dirname "$0")/common.sh"

works query furnace --accuracy 0.1
[ "$(head -1 out)" = "patch,face,side,area,b0,b1,b2" ] || complain "header: $(head -1 out)"
works info furnace --json
cp out info
works query furnace --accuracy 0.1 --patches --json
python3 - <<'PYTHON' || complain "the patches of the furnace are not all there"
import json
info, query = json.load(open("info")), json.load(open("out"))
rows = query["patches"]
assert query["quantity"] == "radiosity"
assert sorted({r["patch"] for r in rows}) == list(range(info["patches"]))
assert len(rows) == info["patches"] + info["two_sided"]
assert abs(sum(r["area"] for r in rows if r["side"] == 0) - info["area"]) < 1e-9 * info["area"]
PYTHON

# B = E + rho H and net flux = B - H on every patch and band, by four queries of the same solve.
for quantity in radiosity irradiance emission net_flux; do
  works query cornell --accuracy 0.1 --quantity $quantity --csv
  mv out $quantity.csv
done
python3 - <<'PYTHON' || complain "the quantities of cornell don't fit together"
import csv
tables = {}
for name in "radiosity", "irradiance", "emission", "net_flux":
    with open(name + ".csv", newline="") as file:
        tables[name] = [[float(r[b]) for b in ("b0", "b1", "b2")] for r in csv.DictReader(file)]
for b, h, e, n in zip(*(tables[k] for k in ("radiosity", "irradiance", "emission", "net_flux"))):
    for band in range(3):
        assert abs(n[band] - (b[band] - h[band])) <= 1e-9 * max(1, abs(b[band]), abs(h[band]))
        assert b[band] >= e[band] >= 0 and h[band] >= 0
assert any(max(e) > 0 for e in tables["emission"])
PYTHON

# Three ways to say where sensors stand give the same rows.
middle=$("$HRAD" info cornell --json | python3 -c '
import json, sys
j = json.load(sys.stdin)
x, y, z = ((l + u) / 2 for l, u in zip(j["lower"], j["upper"]))
print(x, y, z)')
read -r x y z <<<"$middle"
works query cornell --accuracy 0.1 --at "$x,$y,$z:0,1,0" --at="$x,$y,$z:0,0,-2"
mv out at.csv
[ "$(wc -l <at.csv)" = 3 ] || complain "two sensors give other than two rows: $(cat at.csv)"
[ "$(head -1 at.csv)" = "x,y,z,nx,ny,nz,irradiance0,irradiance1,irradiance2,standard_error0,standard_error1,standard_error2" ] ||
  complain "header: $(head -1 at.csv)"
printf '# in the middle\n\n%s,%s , %s\t0 1 0 # up\r\n  %s %s %s 0,0,-2' "$x" "$y" "$z" "$x" "$y" "$z" >sensors
works query cornell --accuracy 0.1 --sensors sensors
cmp -s out at.csv || complain "--sensors and --at disagree: $(cat out)"
"$HRAD" query cornell --accuracy 0.1 --sensors - <sensors >out 2>err
cmp -s out at.csv || complain "--sensors - and --at disagree: $(cat out)"
works query cornell --accuracy 0.1 --json --patches --sensors sensors
holds 'len(j["sensors"]) == 2 and j["sensors"][1]["normal"] == [0, 0, -2] and j["patches"]'
holds 'all(h > 0 and s >= 0 for p in j["sensors"] for h, s in zip(p["irradiance"], p["standard_error"]))'
: >sensors
works query cornell --accuracy 0.1 --sensors sensors
[ "$(wc -l <out)" = 1 ] || complain "no sensors give other than a header"

# A grid: cell centres, the first free coordinate fastest, the normal along the common one.
works query furnace --accuracy 0.1 --grid=0.75,0.1,0.25:0.25,0.1,0.75:2x1 --json
holds '[p["position"] for p in j["sensors"]] == [[0.625, 0.1, 0.5], [0.375, 0.1, 0.5]]'
holds 'all(p["normal"] == [0, 1, 0] for p in j["sensors"])'
works query furnace --accuracy 0.1 --grid 0.1,0,0:0.1,0.2,0.4:1x2 --json
holds '[p["position"] for p in j["sensors"]] == [[0.1, 0.1, 0.1], [0.1, 0.1, 0.30000000000000004]]'
holds 'all(p["normal"] == [1, 0, 0] for p in j["sensors"])'
finish
