# What nearly every source includes, parsed once. That headers include what they use of it is checked by
# the test House.IncludesGoDownwardsOnly, and by the preset dev, which has none of this.
file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/common_headers.cpp" CONTENT "")
add_library(common_headers OBJECT EXCLUDE_FROM_ALL "${PROJECT_BINARY_DIR}/common_headers.cpp")
target_link_libraries(common_headers PRIVATE weft_flags weft_warnings fmt::fmt)
target_precompile_headers(common_headers PRIVATE
  <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <mutex>
  <numeric> <optional> <span> <string> <string_view> <tuple> <utility> <variant> <vector> <fmt/format.h>)

# Sources of a module are compiled many at a time, which saves much processor time: most of what one
# source alone takes is reading headers. So names within unnamed namespaces are unique within a module;
# tests that share names with others of theirs have a namespace each. The preset dev compiles each alone.
function(weft_unity target)
  if(NOT DEFINED CMAKE_UNITY_BUILD)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 24)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# weft_module(NAME [PUBLIC lib...] [PRIVATE lib...])
# The library weft::NAME from every source below src/weft/NAME. PRIVATE libraries are asked for again
# by those who link the installed one (cmake/WeftConfig.cmake.in); HEADERS are libraries of headers
# alone, which are not.
function(weft_module name)
  cmake_parse_arguments(MODULE "" "" "PUBLIC;PRIVATE;HEADERS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/weft/${name}/*.cpp")
  list(FILTER sources EXCLUDE REGEX "/kernels/isa/")
  add_library(weft_${name} STATIC ${sources})
  add_library(weft::${name} ALIAS weft_${name})
  set_target_properties(weft_${name} PROPERTIES EXPORT_NAME ${name})
  target_link_libraries(weft_${name}
    PUBLIC weft_flags ${MODULE_PUBLIC}
    PRIVATE $<BUILD_INTERFACE:weft_warnings> ${MODULE_PRIVATE})
  foreach(headers ${MODULE_HEADERS})
    target_link_libraries(weft_${name} PRIVATE $<BUILD_INTERFACE:${headers}>)
  endforeach()
  target_precompile_headers(weft_${name} REUSE_FROM common_headers)
  weft_unity(weft_${name})
  set_property(GLOBAL APPEND PROPERTY WEFT_MODULES weft_${name})
endfunction()

# Compiles src/weft/NAME/kernels/isa once for every instruction set into the module. Functions get
# the set's name as namespace, so that the linker cannot mistake one for another.
function(weft_kernels name)
  file(GLOB sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/src/weft/${name}/kernels/isa/*.cpp")
  set(flags_baseline "")
  set(flags_avx2 -mavx2)
  set(flags_avx512 -mavx512f -mavx512vl -mavx512dq -mavx512bw -mprefer-vector-width=512)
  foreach(set baseline avx2 avx512)
    add_library(weft_${name}_${set} OBJECT ${sources})
    target_compile_definitions(weft_${name}_${set} PRIVATE WEFT_KERNEL_SET=${set})
    target_compile_options(weft_${name}_${set} PRIVATE ${flags_${set}})
    target_link_libraries(weft_${name}_${set} PRIVATE weft_flags weft_warnings)
    target_sources(weft_${name} PRIVATE $<TARGET_OBJECTS:weft_${name}_${set}>)
  endforeach()
endfunction()
