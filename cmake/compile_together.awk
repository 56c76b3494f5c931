# Which sources of a target are compiled together.
#   awk -f compile_together.awk -v public=1 HEADER...              prints what headers declare: `type NAME` or `other NAME`
#   awk -f compile_together.awk -v most=8 -v lines=2000 DECLARED SOURCE...
#                                                                  prints `UNIT SOURCE` for each source,
#                                                                  unit 0 if it is compiled by itself
# DECLARED is what the first call printed. Two sources share a unit of at most `most` sources and `lines` lines only if
#   - no helper of one (a name declared in an unnamed namespace) has the name of a helper of the other,
#   - neither mentions a public name that is a helper's name in the other,
#   - their aliases agree.
# A source is alone that defines macros, has pragmas, includes a header that stands no second reading, or has a helper
# with the name of a public type. The sources are formatted by clang-format: what is declared at namespace scope begins
# in the first column.

# The name that a line at namespace scope declares, or ""; sets `is_type`.
function declared(text) {
  is_type = 0
  sub(/^\[\[[a-z_]+\]\] /, "", text)
  if (text ~ /^template </) {
    if (text !~ /> [A-Za-z]/) return ""
    sub(/^template <.*> /, "", text)
  }
  if (text ~ /^(struct|class|union|enum class|enum|concept|using) [A-Za-z_0-9]+( final)?( [:=].*)?[ ;{]*$/) {
    sub(/^(struct|class|union|enum class|enum|concept|using) /, "", text)
    match(text, /^[A-Za-z_0-9]+/)
    is_type = 1
    return substr(text, 1, RLENGTH)
  }
  sub(/[(={;[].*/, "", text)
  sub(/[^A-Za-z0-9_]+$/, "", text)
  return match(text, /[A-Za-z_][A-Za-z0-9_]*$/) ? substr(text, RSTART) : ""
}
# Declarations begin in the first column; labels of classes do, too.
function declares(text) {
  return text ~ /^[A-Za-z[]/ && text !~ /^(public|protected|private):/ && text !~ /^(using )?namespace /
}
function add_helper(word) {
  if (word == "") return
  helper[++helpers] = word
  if (word in public_type) alone = 1
}
# constexpr double kOne = 1, kTwo = 2;
function add_further_constants(text) {
  while (match(text, /, k[A-Z][A-Za-z0-9_]* = /)) {
    add_helper(substr(text, RSTART + 2, RLENGTH - 5))
    text = substr(text, RSTART + RLENGTH)
  }
}
function add_mentions(text,  word) {
  while (match(text, /[A-Za-z_][A-Za-z0-9_]*/)) {
    word = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    if ((word in public_name) && !((source, word) in mentioned)) {
      mentioned[source, word] = 1
      mention[++mentions] = word
    }
  }
}
function fits_into(unit,  i, key) {
  if (sources_of[unit] >= most || lines_of[unit] + length_now > lines) return 0
  for (i = 1; i <= helpers; ++i) {
    key = unit SUBSEP helper[i]
    if ((key in unit_helper) || (key in unit_mention)) return 0
  }
  for (i = 1; i <= mentions; ++i) if ((unit SUBSEP mention[i]) in unit_helper) return 0
  for (i = 1; i <= aliases; ++i) {
    key = unit SUBSEP alias[i]
    if ((key in unit_alias) && unit_alias[key] != means[i]) return 0
  }
  return 1
}
function place_source(  unit, i) {
  if (source == "") return
  if (alone) {
    print 0, source
    return
  }
  for (unit = 1; unit <= units; ++unit) if (fits_into(unit)) break
  if (unit > units) units = unit
  for (i = 1; i <= helpers; ++i) unit_helper[unit, helper[i]] = 1
  for (i = 1; i <= mentions; ++i) unit_mention[unit, mention[i]] = 1
  for (i = 1; i <= aliases; ++i) unit_alias[unit, alias[i]] = means[i]
  ++sources_of[unit]
  lines_of[unit] += length_now
  print unit, source
}
public { if (declares($0) && (word = declared($0)) != "") print (is_type ? "type" : "other"), word; next }
FNR == NR { if ($1 == "type") public_type[$2] = 1; else public_name[$2] = 1; next }
FNR == 1 {
  place_source()
  source = FILENAME
  helpers = mentions = aliases = length_now = alone = unnamed = 0
}
{ ++length_now }
/^#(define|pragma)/ || /^#include .tetgen\.h/ { alone = 1 }
/^namespace [{]/ { unnamed = 1; next }
/^}  \/\/ namespace$/ { unnamed = 0; next }
/^(using|namespace) [A-Za-z_0-9]+ = / {
  alias[++aliases] = $2
  means[aliases] = $0
  if (unnamed && $1 == "using" && ($2 in public_type)) alone = 1
  next
}
!/^ *(\/\/|#)/ { add_mentions($0) }
unnamed && declares($0) {
  add_helper(declared($0))
  if ($0 ~ /^(constexpr|const) /) add_further_constants($0)
}
END { if (!public) place_source() }
