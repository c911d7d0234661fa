#!/usr/bin/env bash
# Files that -o names: judged before the solve, written whole after it.
. "$(dirname "$0")/common.sh"

# A solve that would take far too long for a test: whatever is refused here is refused before it.
long='building-x100 --accuracy 0.0005'
for name in x.foo x folder.csv/x .; do
  # shellcheck disable=SC2086
  refuses 2 "endings known here: .hrad, .csv, .vtu" solve $long -o "$name"
done
# shellcheck disable=SC2086
{
  refuses 2 "a scene, not a result" solve $long -o x.obj
  refuses 2 "given twice" solve $long -o x.csv -o ./x.csv
  refuses 5 "no_such_folder" solve $long -o no_such_folder/x.csv
  refuses 5 "no_such_folder" solve $long -o y.vtu -o no_such_folder/x.csv
  mkdir folder.csv
  refuses 5 "is a directory" solve $long -o folder.csv
  touch file
  refuses 5 "file" solve $long -o file/x.csv
  if [ "$(id -u)" != 0 ]; then
    mkdir closed && chmod a-w closed
    refuses 5 "closed" solve $long -o closed/x.csv
    touch fixed.csv && chmod a-w fixed.csv
    refuses 5 "fixed.csv" solve $long -o fixed.csv
  fi
}
refuses 2 "a result, not a scene" scene cornell -o x.csv

# The input is never written over, whatever it is called.
works scene cornell -o scene.obj
cp scene.obj scene.csv
cp scene.obj before
ln scene.csv other.csv
refuses 2 "write over the input" solve ./scene.csv -o scene.csv
refuses 2 "write over the input" export ./scene.csv -o other.csv
cmp -s scene.csv before || complain "the input was changed"

# A built-in scene survives the way through its file.
for name in $("$HRAD" scene --list | grep -v -- -x); do
  works scene "$name" -o written.obj
  [ -s out ] && complain "$ran: output on stdout"
  works info "$name" --json
  mv out direct
  works info written.obj --json
  python3 - <<'PYTHON' || complain "$name: its file holds another scene"
import json
a, b = json.load(open("direct")), json.load(open("out"))
for key in "patches", "dropped", "emitters", "two_sided":
    assert a[key] == b[key], (key, a[key], b[key])
assert abs(a["area"] - b["area"]) <= 1e-9 * a["area"]
for key in "lower", "upper":
    for x, y in zip(a[key], b[key]):
        assert abs(x - y) <= 1e-9 * max(1, abs(x)), key
PYTHON
done

# Several files of one solve; export writes what solve writes; nothing but them appears.
mkdir results
works solve cornell --accuracy 0.1 -o results/one.csv -o results/one.vtu
says "wrote results/one.csv"
says "wrote results/one.vtu"
works export cornell --accuracy 0.1 -o results/two.csv --threads 1
[ -s out ] && complain "$ran: output on stdout"
cmp -s results/one.csv results/two.csv || complain "export and solve write different files"
[ "$(ls results | tr '\n' ' ')" = "one.csv one.vtu two.csv " ] ||
  complain "files appeared: $(ls results)"
head -1 results/one.csv | grep -q '^patch,face,side,x0,y0,z0,x1,y1,z1,x2,y2,z2,area,b0,b1,b2$' ||
  complain "header: $(head -1 results/one.csv)"
finish
