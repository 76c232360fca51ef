# Installs the libraries. find_package(tumble) gives tumble::tumble, which depends on nothing, and tumble::output if what
# it links (cairo, giflib, zlib, HDF5) is found; pkg-config gives tumble.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tumble)
install(TARGETS tumble EXPORT tumbleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT tumbleTargets NAMESPACE tumble:: DESTINATION ${package_dir})
if(TUMBLE_BUILD_OUTPUT)
  get_target_property(tumble_output_links tumble_output LINK_LIBRARIES)
  install(TARGETS tumble_output EXPORT tumbleOutputTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT tumbleOutputTargets NAMESPACE tumble:: DESTINATION ${package_dir})
endif()
# The page that `make viewer` builds.
install(FILES ${PROJECT_BINARY_DIR}/share/tumble/tumble.html DESTINATION share/tumble OPTIONAL)
configure_package_config_file(cmake/tumbleConfig.cmake.in tumbleConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(tumbleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tumbleConfig.cmake ${PROJECT_BINARY_DIR}/tumbleConfigVersion.cmake
        DESTINATION ${package_dir})
# The prefix is known only when installing, so the file is written then.
install(CODE "set(CMAKE_INSTALL_INCLUDEDIR \"${CMAKE_INSTALL_INCLUDEDIR}\")
set(CMAKE_INSTALL_LIBDIR \"${CMAKE_INSTALL_LIBDIR}\")
set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
set(PROJECT_VERSION \"${PROJECT_VERSION}\")
configure_file(\"${PROJECT_SOURCE_DIR}/cmake/tumble.pc.in\"
               \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig/tumble.pc\" @ONLY)")
