# `cmake --install` puts the libraries, their headers and a config package where other projects find them:
# find_package(interstice) then offers interstice::base, ::dem, ::voxel and ::coupling.
install(TARGETS interstice_base interstice_dem interstice_voxel interstice_coupling interstice
        EXPORT interstice_targets
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(house base dem voxel coupling)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${house} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/interstice
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/generated/base/version.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/interstice/base)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/interstice)

set(INTERSTICE_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/interstice)
install(EXPORT interstice_targets NAMESPACE interstice:: FILE intersticeTargets.cmake
        DESTINATION ${INTERSTICE_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/intersticeConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/intersticeConfig.cmake INSTALL_DESTINATION ${INTERSTICE_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/intersticeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/intersticeConfig.cmake ${PROJECT_BINARY_DIR}/intersticeConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/FindOpenVDB.cmake
        DESTINATION ${INTERSTICE_PACKAGE_DIR})
