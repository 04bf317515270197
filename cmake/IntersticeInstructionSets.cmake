# The command for further instruction sets, each built whole and apart, beside it (apps/instruction_set.h).
include(ExternalProject)
foreach(isa IN LISTS INTERSTICE_ISAS)
  ExternalProject_Add(interstice_for_${isa}
    SOURCE_DIR ${PROJECT_SOURCE_DIR}
    BINARY_DIR ${PROJECT_BINARY_DIR}/isa/${isa}
    CMAKE_ARGS -DINTERSTICE_ARCH=${isa} -DINTERSTICE_ISAS= -DINTERSTICE_TESTS=OFF -DINTERSTICE_WERROR=${INTERSTICE_WERROR}
               -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
    BUILD_COMMAND ${CMAKE_COMMAND} --build <BINARY_DIR> --target interstice
    BUILD_ALWAYS ON
    USES_TERMINAL_BUILD ON
    INSTALL_COMMAND ${CMAKE_COMMAND} -E copy <BINARY_DIR>/interstice ${PROJECT_BINARY_DIR}/interstice-${isa})
  install(PROGRAMS ${PROJECT_BINARY_DIR}/interstice-${isa} DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/interstice)
endforeach()
