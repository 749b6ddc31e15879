# SPDX-License-Identifier: Apache-2.0
# embed_files(TARGET FUNCTION HEADER FILES...)
# Makes a source file at build time that defines `std::string_view FUNCTION(std::string_view name)`, declared in HEADER:
# the text of the named file (its name without folder), empty where there is none. As a script (cmake -P) it writes it.
if(CMAKE_SCRIPT_MODE_FILE)
  set(body "")
  string(REPLACE "," ";" EMBED_FILES "${EMBED_FILES}")
  foreach(path IN LISTS EMBED_FILES)
    get_filename_component(name ${path} NAME)
    file(READ ${path} text)
    string(APPEND body "  if (name == \"${name}\") {\n    return R\"embedded(${text})embedded\";\n  }\n")
  endforeach()
  file(WRITE ${EMBED_OUTPUT}
       "// Made at build time.\n#include \"${EMBED_HEADER}\"\n\nnamespace sonar {\n\n"
       "std::string_view ${EMBED_FUNCTION}(std::string_view name) {\n${body}  return {};\n}\n\n}  // namespace sonar\n")
  return()
endif()

set(SONAR_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(embed_files target function header)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  list(JOIN ARGN "," joined)
  add_custom_command(OUTPUT ${output}
                     COMMAND ${CMAKE_COMMAND} -DEMBED_FILES=${joined} -DEMBED_FUNCTION=${function} -DEMBED_HEADER=${header}
                             -DEMBED_OUTPUT=${output} -P ${SONAR_EMBED_SCRIPT}
                     DEPENDS ${ARGN} ${SONAR_EMBED_SCRIPT} VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
