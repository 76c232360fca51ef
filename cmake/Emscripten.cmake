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

# Exceptions carry the errors of bad input to the page.
add_compile_options(-fexceptions)
add_link_options(-fexceptions)
