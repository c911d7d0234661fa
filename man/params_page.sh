#!/bin/sh
# Makes hrad-params(7) from the table that `hrad params` prints:
# params_page.sh HRAD hrad-params.7.in hrad-params.7
set -eu
hrad=$1 template=$2 page=$3

table=$("$hrad" params)
# The table's columns begin where their headings do, but for the defaults, which stand to the right.
printf '%s\n' "$table" | awk -v template="$template" '
  function column(from, to,  text) {
    text = to ? substr($0, from, to - from) : substr($0, from)
    gsub(/^ +| +$/, "", text)
    return text
  }
  function masked(text) {  # for mdoc
    gsub(/\\/, "\\e", text)
    return text ~ /^[.\047]/ ? "\\&" text : text
  }
  NR == 1 {
    allowed = index($0, "ALLOWED"); unit = index($0, "UNIT")
    decides = index($0, "DECIDES"); meaning = index($0, "MEANING")
    if (!(4 < allowed && allowed < unit && unit < decides && decides < meaning)) exit 1
    next
  }
  {
    values = column(allowed, unit)
    if ($2 != "text") {
      sub(/ \.\. /, " to ", values)
      values = ($2 == "int" ? "A whole number from " : "A number from ") values
      if (column(unit, decides) != "") values = values " " column(unit, decides)
    } else if (values == "any text") {
      values = "Any text"
    } else {
      gsub(/\|/, ", ", values)
      match(values, /, [^,]*$/)
      values = "One of " substr(values, 1, RSTART - 1) " and " substr(values, RSTART + 2)
    }
    row = ".It Va " $1 "\n" masked(column(meaning, 0)) "\n" masked(values) "; by default " $3 ".\n"
    rows[column(decides, meaning)] = rows[column(decides, meaning)] row
  }
  END {
    if (rows["result"] == "" || rows["run"] == "") exit 1
    while ((status = getline line <template) > 0) {
      if (line == "@RESULT@") printf "%s", rows["result"]
      else if (line == "@RUN@") printf "%s", rows["run"]
      else print line
    }
    if (status < 0) exit 1
  }' >"$page.part"
mv "$page.part" "$page"
