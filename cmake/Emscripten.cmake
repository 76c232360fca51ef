# Header-only libraries for emscripten, in a folder of links: the system's include folder would mix the headers of
# the host's C library in.
set(TUMBLE_WASM_INCLUDE ${CMAKE_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${TUMBLE_WASM_INCLUDE})
foreach(folder eigen3/Eigen fmt boost toml++)
  get_filename_component(name ${folder} NAME)
  if(NOT EXISTS /usr/include/${folder})
    message(FATAL_ERROR "Tumble: /usr/include/${folder} is missing; scripts/deps.sh build installs it")
  endif()
  file(CREATE_LINK /usr/include/${folder} ${TUMBLE_WASM_INCLUDE}/${name} SYMBOLIC)
endforeach()
add_library(Eigen3::Eigen INTERFACE IMPORTED)
target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${TUMBLE_WASM_INCLUDE})
add_library(fmt::fmt-header-only INTERFACE IMPORTED)
target_include_directories(fmt::fmt-header-only SYSTEM INTERFACE ${TUMBLE_WASM_INCLUDE})
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)

# Exceptions carry the errors of bad input to the page. emscripten compiles code without landing pads, which is
# smaller (an error costs what the callers in between had on the heap); files that catch ask for them.
add_link_options(-fwasm-exceptions)

# The page is one file, for which size counts more than the last of speed: these bits are those of every other build.
string(REPLACE "-O3" "-Oz" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
add_compile_options(-msign-ext -mnontrapping-fptoint -mbulk-memory)  # shorter, and known to all browsers of this decade
add_compile_definitions(FMT_STATIC_THOUSANDS_SEPARATOR=',' FMT_USE_FLOAT=0 FMT_USE_LONG_DOUBLE=0 FMT_USE_INT128=0)
