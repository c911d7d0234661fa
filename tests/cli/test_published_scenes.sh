#!/usr/bin/env bash
# Published scenes as their authors left them: hrad info names the faults that they really have, and
# each is solved. They lie in the folder that HRAD_SCENES names, else in shared/scenes beside the
# source tree.
. "$(dirname "$0")/common.sh"
scenes=${HRAD_SCENES:-$HRAD_SOURCE_DIR/../shared/scenes}
[ -d "$scenes" ] || { echo "skipped: no folder $scenes; HRAD_SCENES names it"; exit 77; }

# has SCENE PATCHES DROPPED EMITTERS FAULTS...: hrad info counts so, and names these faults and no others.
has() {
  local scene=$1 patches=$2 dropped=$3 emitters=$4 fault
  shift 4
  works info "$scenes/$scene.obj"
  for fault in "$@"; do says "$fault"; done
  works info "$scenes/$scene.obj" --json
  holds "[j[k] for k in ('patches', 'dropped', 'emitters')] == [$patches, $dropped, $emitters]"
  for fault in "$@"; do holds "any('''$fault''' in d for d in j['diagnostics'])"; done
  holds "len(j['diagnostics']) == $#"
}

# is_solved SCENE ACCURACY SHARE: to its end or as far as it gets; what is absorbed or escapes is what
# is emitted, in every band, but for that share.
is_solved() {
  run solve "$scenes/$1.obj" --accuracy "$2" --json
  [ "$code" = 0 ] || [ "$code" = 7 ] || complain "$ran: exit code $code: $(cat err)"
  holds "j['status'] == {0: 'HRAD_OK', 7: 'HRAD_NOT_CONVERGED'}[$code]"
  holds "min(j['emitted']) > 0"
  holds "all(abs(e - a - b - x) <= $3 * e for e, a, b, x in zip(*(j[k] for k in 'emitted absorbed absorbed_back escaped'.split())))"
}

# The bottoms of its two boxes stand twice in the file.
has cornell/CornellBox-Original 36 4 2 \
  "4 patches that repeat an earlier one are dropped (first: patch 20, as 16)"
is_solved cornell/CornellBox-Original 0.05 0.002

has cornell/CornellBox-Empty-RG 12 0 2
is_solved cornell/CornellBox-Empty-RG 0.05 0.002

has cornell/CornellBox-Sphere 2188 0 2 "2 materials shine (Ks)"
is_solved cornell/CornellBox-Sphere 0.05 0.002

has cornell/CornellBox-Water 7088 0 2 "3 materials shine (Ks)" \
  "7.7 % of the rays that look for it meet the backs of one-sided patches"
is_solved cornell/CornellBox-Water 0.05 0.002

has holodeck/holodeck 4010 4 8 "1 channels of Kd of 1 or more are clamped to 0.99" \
  "3 textures are ignored" "2 materials shine (Ks)" \
  "4 repeated corners are left out of their faces" \
  "4 patches without area are dropped (first: patch 2825, face 1491)"
is_solved holodeck/holodeck 0.03 0.002

# A coarser balance is asked of it: 16 of its 1192 square metres are pressed against other surfaces.
has staircase2/staircase2 31007 2432 96 \
  "2432 patches without area are dropped (first: patch 27715, face 27715)" \
  "12.3 % of the rays that look for it meet the backs of one-sided patches"
is_solved staircase2/staircase2 0.03 0.006

# Nearly all that its lamps light are backs.
has veach-bidir/veach-bidir 11544 0 4 \
  "55.8 % of the rays that look for it meet the backs of one-sided patches"
says "load with the parameter sides = flip or two-sided (hrad: --flip, --two-sided)"
is_solved veach-bidir/veach-bidir 0.1 0.002
finish
