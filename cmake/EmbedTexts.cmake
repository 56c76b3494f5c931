# Writes a source file that defines `const std::map<std::string, std::string>& FUNCTION()` with the texts of FILES by
# name (without .json): embed_texts(OUTPUT FUNCTION HEADER FILES...)
function(embed_texts output function header)
  set(entries "")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
    get_filename_component(name ${file} NAME)
    string(REGEX REPLACE "\\.json$" "" name ${name})
    file(READ ${file} text)
    string(APPEND entries "        {\"${name}\", R\"~~(${text})~~\"},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${output} @ONLY CONTENT
"#include \"${header}\"

namespace vesselbench {

const std::map<std::string, std::string>& ${function}() {
    static const std::map<std::string, std::string> texts = {
${entries}    };
    return texts;
}

}  // namespace vesselbench
")
endfunction()
