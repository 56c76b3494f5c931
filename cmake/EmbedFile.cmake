# Writes a source file that defines `std::span<const unsigned char> FUNCTION()` with the bytes of FILE:
# embed_file(OUTPUT FUNCTION HEADER FILE). The assembler includes the bytes; the compiler never parses them.
function(embed_file output function header file)
  file(SHA256 ${file} hash)  # a changed file changes the source: compiler caches notice
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT
"// SHA-256 of the embedded file: ${hash}
#include \"${header}\"

asm(R\"(
.pushsection .rodata
.balign 16
${function}_begin:
.incbin \"${file}\"
${function}_end:
.popsection
)\");

extern const unsigned char begin[] asm(\"${function}_begin\");
extern const unsigned char end[] asm(\"${function}_end\");

namespace vesselbench {

std::span<const unsigned char> ${function}() {
    return {begin, end};
}

}  // namespace vesselbench
")
endfunction()
