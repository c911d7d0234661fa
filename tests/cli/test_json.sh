#!/usr/bin/env bash
# --json of every command that has it: one valid object with the promised fields, and the same
# numbers as the library gives.
. "$(dirname "$0")/common.sh"

works solve cornell --accuracy 0.1 --threads 2 --json -o result.csv
python3 -m json.tool out >/dev/null || complain "$ran: not JSON"
holds 'all(type(j[k]) is int for k in "iterations patches elements leaves links rays ranks threads memory_peak_bytes".split())'
holds 'j["converged"] is True and j["status"] == "HRAD_OK"'
holds 'all(len(j[k]) == 3 for k in "emitted absorbed absorbed_back escaped".split())'
holds 'set(j["seconds"]) == set("load initial linking iterative output".split())'
holds 'set(j["messages"]) == set(j["bytes"]) == set("RUT")'
holds 'len(j["state_hash"]) == 16 and int(j["state_hash"], 16) > 0'
holds 'j["ranks"] == 1 and j["threads"] == 2 and j["cpu_seconds"] >= 0'
holds 'j["patches"] > 0 and j["leaves"] >= j["patches"] and j["links"] > j["swept_links"] > 0 and j["rays"] > 0'
holds 'j["error_estimate"] is None or 0 <= j["error_estimate"] <= 0.1'
holds 'j["files"] == ["result.csv"]'
# Each term is measured by itself; together they are what was emitted, within the accuracy.
holds 'all(abs(e - a - b - x) <= 0.1 * e for e, a, b, x in zip(*(j[k] for k in "emitted absorbed absorbed_back escaped".split())))'
hash=$(python3 -c 'import json; print(json.load(open("out"))["state_hash"])')
works solve cornell --accuracy 0.1 --threads 1
says "$hash"
works query cornell --accuracy 0.1 --json
holds "j['state_hash'] == '$hash'"
works solve furnace --accuracy 0.1 --set bands=1 --json --quiet
holds 'len(j["emitted"]) == 1'
[ -s err ] && complain "$ran: --quiet is not"

works info cornell --json --accuracy 0.05
holds 'j["patches"] == sum(m["patches"] for m in j["materials"]) + j["dropped"]'
holds 'abs(j["area"] - sum(m["area"] for m in j["materials"])) < 1e-9 * j["area"]'
holds 'j["emitters"] > 0 and sum(j["emitted"]) > 0 and len(j["lower"]) == len(j["upper"]) == 3'
holds 'all(l <= u for l, u in zip(j["lower"], j["upper"]))'
holds '[p["name"] for p in j["parameters"] if not p["is_default"]] == ["accuracy"]'
works info cornell
grep -q '^\*' out && complain "$ran: a parameter at its default is marked"
works info cornell --set seed=7
grep -Eq '^\* +seed +7 \(default 1\)$' out || complain "$ran: seed is not marked: $(cat out)"

works machine --json
holds 'len(j) > 2'
works machine --threads 1
[ -s out ] || complain "$ran: says nothing"

works params --json
holds 'len({p["name"] for p in j["parameters"]}) == len(j["parameters"]) >= 15'
holds 'all(p["type"] in ("int", "double", "text") and p["decides"] in ("result", "run") and p["help"] for p in j["parameters"])'
holds '[p for p in j["parameters"] if p["name"] == "accuracy"][0]["minimum"] == 0.0005'
python3 -c '
import json
for p in json.load(open("out"))["parameters"]: print(p["name"] + "=" + p["default"])' >defaults
# Every default can be set as it is printed.
while read -r setting; do works info furnace --set "$setting"; done <defaults
works params
[ "$(tail -n +2 out | wc -l)" = "$(wc -l <defaults)" ] || complain "params: rows are missing"

# Names that JSON can't hold as they are.
printf 'newmtl a"b\\c\nKd 0.5 0.5 0.5\nKe 1 1 1\n' >scene.mtl
printf 'mtllib scene.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a"b\\c\nf 1 2 3\n' >$'odd\xff "name".obj'
works info $'odd\xff "name".obj' --json
holds '"a\"b\\c" in [m["name"] for m in j["materials"]]'
finish
