# Compile options that every target of the project shares, and one function that declares a library.

add_library(interstice_options INTERFACE)
target_compile_options(interstice_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow)
if(INTERSTICE_WERROR)
  target_compile_options(interstice_options INTERFACE -Werror)
endif()
if(INTERSTICE_ARCH)
  target_compile_options(interstice_options INTERFACE "-march=${INTERSTICE_ARCH}")
endif()
if(INTERSTICE_SANITIZE)
  target_compile_options(interstice_options INTERFACE "-fsanitize=${INTERSTICE_SANITIZE}" -fno-omit-frame-pointer
                                                      -fno-sanitize-recover=all)
  target_compile_definitions(interstice_options INTERFACE INTERSTICE_SANITIZED)
  target_link_options(interstice_options INTERFACE "-fsanitize=${INTERSTICE_SANITIZE}")
endif()

# interstice_object_library(NAME SOURCES a.cpp b.cpp DEPENDS x y)
# A room of a library: compiled apart, so that it can be tested apart, and archived into its house later.
function(interstice_object_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(${name} OBJECT ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                            $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/interstice>)
  target_link_libraries(${name} PUBLIC ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:interstice_options>)
endfunction()

# interstice_library(NAME SOURCES ... DEPENDS ...) declares interstice_NAME, alias interstice::NAME.
function(interstice_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_library(interstice_${name} STATIC ${ARG_SOURCES})
  add_library(interstice::${name} ALIAS interstice_${name})
  set_target_properties(interstice_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(interstice_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                             $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/interstice>)
  target_link_libraries(interstice_${name} PUBLIC ${ARG_DEPENDS} PRIVATE $<BUILD_INTERFACE:interstice_options>)
endfunction()

# interstice_test(NAME SOURCES ... DEPENDS ... [LABELS ...] [TIMEOUT s]): a GoogleTest program.
function(interstice_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARG_DEPENDS} interstice_options GTest::gtest GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE INTERSTICE_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(INTERSTICE_SANITIZE)
    math(EXPR ARG_TIMEOUT "20 * ${ARG_TIMEOUT}")
  endif()
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
