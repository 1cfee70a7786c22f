# The page of a run, view/page/page.html, as a source file: its halves before and behind the data, in pieces that any
# compiler takes.
set(page ${PROJECT_SOURCE_DIR}/view/page/page.html)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${page})

function(embed_pieces text result)
  set(pieces "")
  string(LENGTH "${text}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${text}" ${begin} 16000 piece)
    string(APPEND pieces "    R\"dalembert(${piece})dalembert\",\n")
    math(EXPR begin "${begin} + 16000")
  endwhile()
  set(${result} "  static const std::string_view pieces[] = {\n${pieces}  };\n  return pieces;" PARENT_SCOPE)
endfunction()

file(READ ${page} text)
set(mark "<!--DATA-->")
string(FIND "${text}" "${mark}" place)
if(place EQUAL -1 OR text MATCHES "\\)dalembert\"")
  message(FATAL_ERROR "${page}: has no place for the data, or text that ends a string")
endif()
string(SUBSTRING "${text}" 0 ${place} before)
string(LENGTH "${mark}" length)
math(EXPR place "${place} + ${length}")
string(SUBSTRING "${text}" ${place} -1 behind)
embed_pieces("${before}" before)
embed_pieces("${behind}" behind)
set(embedded ${PROJECT_BINARY_DIR}/page_template.cpp)
file(CONFIGURE OUTPUT ${embedded} @ONLY CONTENT "// Made from view/page/page.html by cmake/embed_page.cmake.
#include <dalembert/view/page_template.h>

namespace dalembert {

std::span<const std::string_view> page_before_data() {
@before@
}
std::span<const std::string_view> page_behind_data() {
@behind@
}

}  // namespace dalembert
")
