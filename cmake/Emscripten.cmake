# Exceptions carry the errors of bad input to the page. emscripten compiles code without landing pads, which is
# smaller (an error costs what the callers in between had on the heap); files that catch ask for them.
add_link_options(-fwasm-exceptions)

# The page is one file, for which size counts more than the last of speed: these bits are those of every other build.
string(REPLACE "-O3" "-Oz" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
add_compile_options(-msign-ext -mnontrapping-fptoint -mbulk-memory)  # shorter, and known to all browsers of this decade
add_compile_definitions(FMT_STATIC_THOUSANDS_SEPARATOR=',' FMT_USE_FLOAT=0 FMT_USE_LONG_DOUBLE=0 FMT_USE_INT128=0)
