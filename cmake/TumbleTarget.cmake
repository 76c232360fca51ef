# What every target of the project is compiled with.
#
# -ffp-contract=off: the compiler must not fuse a * b + c, or states would differ between instruction sets.
# EIGEN_DONT_VECTORIZE: Eigen's sums must not depend on the width of a vector register.
# -fno-tree-slp-vectorize: g++ 12 packs pairs of the step's scalars into vector registers by way of memory, and each
# round trip costs a stall: a drop takes 1.1 to 1.6 times as long with it.
# -fno-semantic-interposition: lets g++ inline within a file although the code is position independent, as clang does.
function(tumble_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF)
  if(NOT EMSCRIPTEN)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_options(${name} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow
                                         $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize -fno-semantic-interposition>
                                         $<$<BOOL:${TUMBLE_WERROR}>:-Werror>)
  if(TUMBLE_SANITIZE)
    target_compile_options(${name} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=all)
    target_link_options(${name} PUBLIC -fsanitize=address,undefined)
  endif()
  target_compile_definitions(${name} PRIVATE EIGEN_DONT_VECTORIZE)
endfunction()
