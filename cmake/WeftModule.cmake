# weft_module(NAME [PUBLIC lib...] [PRIVATE lib...])
# The library weft::NAME from every source below src/weft/NAME.
function(weft_module name)
  cmake_parse_arguments(MODULE "" "" "PUBLIC;PRIVATE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/weft/${name}/*.cpp")
  add_library(weft_${name} STATIC ${sources})
  add_library(weft::${name} ALIAS weft_${name})
  set_target_properties(weft_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(weft_${name}
    PUBLIC weft_flags ${MODULE_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:weft_warnings> ${MODULE_PRIVATE})
endfunction()
