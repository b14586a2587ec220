# Language level, warnings and code generation for every target of the project.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE RelWithDebInfo CACHE STRING "Build type" FORCE)
endif()

if(NOT CMAKE_CXX_COMPILER_LAUNCHER)
    find_program(GHOSTLIGHT_CCACHE ccache)
    if(GHOSTLIGHT_CCACHE)
        set(CMAKE_C_COMPILER_LAUNCHER ${GHOSTLIGHT_CCACHE})
        set(CMAKE_CXX_COMPILER_LAUNCHER ${GHOSTLIGHT_CCACHE})
    endif()
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 sees an overlapping copy in every `"text" + std::string` (its bug 105651), overflows in
    # fmt's buffers and uninitialised values in std::variant, none of which there are; clang-tidy
    # (./dev lint) still looks for the real ones.
    add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-maybe-uninitialized)
endif()
if(GHOSTLIGHT_WERROR)
    add_compile_options(-Werror)
endif()

# These two let the compiler vectorise loops with square roots and selects, worth 3 to 6 times in
# the trace, and keep NaN guards working. -ffast-math would not, so it is never used. They are the
# same for every target, since the trace is a template that core, tests and benchmarks instantiate.
add_compile_options(-fno-math-errno -fno-trapping-math)

set(optimised "$<CONFIG:Release,RelWithDebInfo>")
get_directory_property(options_of_all COMPILE_OPTIONS)
# Line tables are enough for back traces and profiles, and build much faster than full debug
# information; the build type Debug has that.
set(GHOSTLIGHT_FAST_OPTIONS
    ${options_of_all} $<${optimised}:-O3> $<$<CONFIG:RelWithDebInfo>:-g1>
)
if(GHOSTLIGHT_SANITIZE)
    add_compile_options(
        -fsanitize=${GHOSTLIGHT_SANITIZE}
        -fno-sanitize-recover=all
        -fno-omit-frame-pointer
    )
    # Half the time to build; reports still name their lines.
    add_compile_options($<${optimised}:-O1> $<$<CONFIG:RelWithDebInfo>:-g1>)
    add_link_options(-fsanitize=${GHOSTLIGHT_SANITIZE})
    add_compile_definitions(_GLIBCXX_ASSERTIONS)
else()
    set_directory_properties(PROPERTIES COMPILE_OPTIONS "${GHOSTLIGHT_FAST_OPTIONS}")
endif()

if(GHOSTLIGHT_ASSERTS)
    foreach(config IN ITEMS RELEASE RELWITHDEBINFO)
        string(REPLACE "-DNDEBUG" "" CMAKE_CXX_FLAGS_${config} "${CMAKE_CXX_FLAGS_${config}}")
        string(REPLACE "-DNDEBUG" "" CMAKE_C_FLAGS_${config} "${CMAKE_C_FLAGS_${config}}")
    endforeach()
endif()

# Programs name only the libraries they call themselves.
add_link_options(-Wl,--as-needed)
