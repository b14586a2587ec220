# ghostlight_test_group(<label> FOLDER <folder> LIBRARIES <target>... [PROGRAM <target>]
#                       [MAIN <source>] [NEEDS_DISPLAY])
#
# One GoogleTest program, ghostlight_<label>_tests, from all sources below tests/<folder>. Each of
# its test suites becomes one ctest entry "<label>.<suite>" with the label, or the label "slow" if
# the suite's name ends in "Slow". The suites are listed when ctest starts, not at build time.
#
# A group is left out while it has no sources, or while the targets it needs do not exist.
function(ghostlight_test_group label)
    cmake_parse_arguments(arg "NEEDS_DISPLAY" "FOLDER;PROGRAM;MAIN" "LIBRARIES" ${ARGN})

    ghostlight_sources(sources ${arg_FOLDER}/*.cpp ${arg_FOLDER}/*.h)
    set(units ${sources})
    list(FILTER units INCLUDE REGEX "_test\\.cpp$")
    if(NOT units)
        return()
    endif()
    foreach(needed IN LISTS arg_LIBRARIES arg_PROGRAM)
        if(NOT TARGET ${needed})
            return()
        endif()
    endforeach()

    set(name ghostlight_${label}_tests)
    add_executable(${name} ${sources} ${arg_MAIN})
    target_link_libraries(
        ${name}
        PRIVATE ${arg_LIBRARIES}
                $<TARGET_NAME_IF_EXISTS:ghostlight_test_kits>
                ghostlight_test_paths
                nlohmann_json::nlohmann_json
                fmt::fmt
                GTest::gmock
                GTest::gtest
    )
    if(arg_MAIN)
        set_target_properties(${name} PROPERTIES AUTOMOC ON)
    else()
        target_link_libraries(${name} PRIVATE GTest::gtest_main)
    endif()
    if(arg_PROGRAM)
        add_dependencies(${name} ${arg_PROGRAM})
    endif()

    set(GROUP_LABEL ${label})
    set(GROUP_LOCK)
    set(GROUP_ENVIRONMENT)
    if(arg_NEEDS_DISPLAY)
        # One window at a time: they share the keyboard focus.
        set(GROUP_LOCK display)
        # Graphics drivers and D-Bus keep memory to the end of the process, some in modules that
        # are unloaded by then and cannot be told from ours.
        set(GROUP_ENVIRONMENT "ASAN_OPTIONS=path_list_append:detect_leaks=0")
    endif()
    set(script ${CMAKE_CURRENT_BINARY_DIR}/${name}_suites.cmake)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/ghostlight_suites.cmake.in ${script}.in @ONLY)
    file(GENERATE OUTPUT ${script} INPUT ${script}.in)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${script})
endfunction()
