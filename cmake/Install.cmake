# Installs the core: find_package(tumble) gives tumble::tumble, pkg-config gives tumble. It depends on nothing.
install(TARGETS tumble EXPORT tumbleTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/tumble)
install(EXPORT tumbleTargets NAMESPACE tumble:: DESTINATION ${package_dir})
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
