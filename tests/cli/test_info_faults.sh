#!/usr/bin/env bash
# hrad info names the faults of a scene: those of a published one, and small ones made after faults
# that published scenes have. Nothing it prints can be mistaken for a command to the terminal.
. "$(dirname "$0")/common.sh"

# diagnoses TEXT SCENE [OPTIONS...]: hrad info names the fault, in text and in JSON.
diagnoses() {
  local text=$1
  shift
  works info "$@"
  says "doubtful: "
  says "$text"
  works info "$@" --json
  holds "any(\"\"\"$text\"\"\" in d for d in j['diagnostics'])"
}

# keeps_quiet_about TEXT SCENE [OPTIONS...]
keeps_quiet_about() {
  local text=$1
  shift
  works info "$@"
  grep -qF -- "$text" out && complain "$ran: says '$text': $(cat out)"
}

# The original Cornell box has the bottoms of its two boxes twice.
box=$HRAD_SOURCE_DIR/tests/cli/scenes/CornellBox-Original.obj
diagnoses "4 patches that repeat an earlier one are dropped (first: patch 20, as 16)" "$box"
holds 'j["patches"] == 36 and j["dropped"] == 4 and j["emitters"] == 2 and len(j["materials"]) == 8'
holds 'len(j["diagnostics"]) == 1'
works solve "$box" --accuracy 0.2 --json
holds 'all(abs(e - a - b - x) <= 0.1 * e for e, a, b, x in zip(*(j[k] for k in "emitted absorbed absorbed_back escaped".split())))'

# Triangles whose corners lie at one place, or on one line.
cat >flat.obj <<'OBJ'
mtllib flat.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 1 0 0
v 2 0 0
usemtl lamp
f 1 2 3
f 1 2 4
f 1 2 5
f 2 2 3
OBJ
printf 'newmtl lamp\nKd 0.5\nKe 1\n' >flat.mtl
diagnoses "3 patches without area are dropped (first: patch 1, face 1)" flat.obj
holds 'j["patches"] == 4 and j["dropped"] == 3'

# A room whose walls face outward, lit from within.
cat >inside_out.obj <<'OBJ'
mtllib flat.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v .4 .4 .9
v .6 .4 .9
v .5 .6 .9
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
usemtl lamp
f 11 10 9
OBJ
diagnoses "meet the backs of one-sided patches" inside_out.obj
diagnoses "--flip, --two-sided" inside_out.obj
keeps_quiet_about "backs of one-sided" inside_out.obj --two-sided
works solve inside_out.obj --accuracy 0.2 --json
holds 'any("meet the backs of one-sided patches" in d for d in j["diagnostics"])'
holds 'j["absorbed_back"][0] > 0.99 * j["emitted"][0]'

# What can't be solved is said without a solve, and is no reason to say nothing else.
printf 'v 0 0 0\nv 1e20 0 0\nv 0 1e20 0\nf 1 2 3\n' >huge.obj
diagnoses "can't be solved: the scene's size" huge.obj
refuses 3 "choose another unit" solve huge.obj
printf 'v 0 0 0\n' >empty.obj
diagnoses "can't be solved: the scene has no patches" empty.obj

# Nothing is silent.
printf 'newmtl glass\nKd 1.5 0.5 0.5\nKs 1 1 1\nd 0.1\nmap_Kd x.png\nkd 1\n' >doubtful.mtl
printf 'mtllib doubtful.mtl\nmtllib none.mtl\nmtllib doubtful.mtl\nv 0 0 0\nv 1e-999 1 0\nv 1 0 0\nl 1 2\nfoo\nusemtl glass\nf 1 2 2 3\nusemtl none\nf 3 2 1\nf 1 2 3 1 3\n' >doubtful.obj
for text in "clamped to 0.99 (first: doubtful.mtl:2)" "1 materials shine (Ks)" \
  "1 materials let light through (d, Tr)" "1 textures are ignored" \
  "1 unknown statements about materials" "doubtful.obj:2: no file 'none.mtl'" \
  "1 mtllib that repeat an earlier one" "1 numbers are too small" "1 statements 'l' are ignored" \
  "1 unknown statements are ignored" "1 repeated corners" "material 'none' is unknown" \
  "1 faces cross themselves" "no patch emits"; do
  diagnoses "$text" doubtful.obj
done

# Refused with the line.
printf 'mtllib ../x.mtl\n' >out.obj
refuses 3 "out.obj:1: mtllib '../x.mtl' lies outside the folder" info out.obj
mkfifo pipe.mtl && printf '\nmtllib pipe.mtl\n' >pipe.obj
refuses 3 "pipe.obj:2: mtllib 'pipe.mtl': not a regular file" info pipe.obj
printf '\nv 0 0 \0' >zero.obj
refuses 3 "zero.obj:2: a zero byte" info zero.obj
printf '\377\376v\0' >wide.obj
refuses 3 "wide.obj:1: this is UTF-16" info wide.obj
printf 'csh rm x\n' >csh.obj
refuses 3 "csh.obj:1: csh is refused" info csh.obj

# Names with control characters, and long ones.
long=$(printf 'x%.0s' $(seq 5000))
printf 'newmtl red\033[31m\302\233\nKd 0.5\nnewmtl %s\nKd 0.5\n' "$long" >names.mtl
printf 'mtllib names.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\033[31m\302\233\nf 1 2 3\nusemtl \033c\nf 1 2 3\n' >names.obj
works info names.obj
says "red?[31m?"
LC_ALL=C grep -q $'[\001-\010\013-\037]' out err && complain "$ran: prints control characters"
[ "$(wc -L <out)" -lt 300 ] || complain "$ran: prints a name of any length"
works info names.obj --json
holds "'x' * 5000 in [m['name'] for m in j['materials']]"
finish
