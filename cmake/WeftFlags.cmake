# One set of flags for all code that feeds a result: the same bits on every x86-64 processor.
# No fused multiply-add, no fast-math, no -march: see docs/decisions/0001-one-result-everywhere.md.
add_library(weft_flags INTERFACE)
target_compile_features(weft_flags INTERFACE cxx_std_20)
target_compile_options(weft_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math -fopenmp-simd -pthread)
# The Python module is a shared object made of the same archives. Programs lose next to nothing by that, as
# the linker binds calls of their own functions directly.
target_compile_options(weft_flags INTERFACE "$<BUILD_INTERFACE:-fPIC;-fno-semantic-interposition>")
target_include_directories(weft_flags INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>"
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>"
  "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
set_target_properties(weft_flags PROPERTIES EXPORT_NAME flags)

# Warnings stay private to this project's own targets.
add_library(weft_warnings INTERFACE)
target_compile_options(weft_warnings INTERFACE -Wall -Wextra -Wpedantic -Wnon-virtual-dtor
  -Woverloaded-virtual -Wcast-align -Wunused
  $<$<CXX_COMPILER_ID:Clang>:-Wno-pass-failed>)
if(WEFT_WARNINGS_AS_ERRORS)
  # Names may hide those of another source that is compiled together with theirs.
  target_compile_options(weft_warnings INTERFACE -Werror
    $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>)
endif()

# For code where little time is spent, such as tests: compiled in half the time. At -O1 GCC 12 sees
# overflows in the joining of std::strings that are none.
add_library(weft_light INTERFACE)
target_compile_options(weft_light INTERFACE
  "$<$<CONFIG:Release>:-O1;-Wno-array-bounds;-Wno-stringop-overflow>")

if(WEFT_SANITIZE)
  target_compile_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE})
endif()
