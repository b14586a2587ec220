# Reads every #include of the project and the programs' link lines, and fails on what the house
# rules of docs/architecture.md forbid.
#
# cmake -DSOURCE_DIR=... [-DCLI_PROGRAM=... -DREADELF=...] -P architecture_test.cmake

set(qt "Q[A-Z][A-Za-z]*[>\"/]|Qt[A-Z][A-Za-z]*/|q[a-z]+\\.h")
set(gl "epoxy/|GL/|GLES[0-9]*/|EGL/|KHR/|GLFW/|glad/")
set(vtk "vtk[A-Za-z0-9_]*\\.h")
set(findings)

# forbid(<folder> <reason> EXCEPT <regex of paths> PATTERNS <regex of what follows #include < or ">...)
function(forbid folder reason except)
    file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/${folder}/*.h
         ${SOURCE_DIR}/${folder}/*.cpp)
    list(JOIN ARGN "|" forbidden)
    foreach(file IN LISTS files)
        if(except AND file MATCHES "${except}")
            continue()
        endif()
        file(STRINGS ${SOURCE_DIR}/${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
        foreach(line IN LISTS includes)
            if(line MATCHES "include[ \t]*[<\"](${forbidden})")
                string(STRIP "${line}" line)
                list(APPEND findings "${file}: ${line} -- ${reason}")
            endif()
        endforeach()
    endforeach()
    set(findings ${findings} PARENT_SCOPE)
endfunction()

forbid(core "core knows no Qt, OpenGL or VTK" "" "${qt}" "${gl}" "${vtk}")
forbid(core "core is the lowest layer" "" "render/" "widgets/" "app/" "tests/")
forbid(core "OpenImageIO, JSON and XML stay in core/io" "^core/io/" "OpenImageIO/" "nlohmann/"
       "pugi")
forbid(core "Ceres' solver stays in core/fit (ceres/jet.h may be used elsewhere)" "^core/fit/"
       "ceres/([^j]|j[^e]|jet[^.])")
forbid(render "render knows no Qt or VTK" "" "${qt}" "${vtk}")
forbid(render "render is below widgets and app" "" "widgets/" "app/" "tests/")
forbid(render "OpenImageIO and JSON stay in core/io" "" "OpenImageIO/" "nlohmann/")
forbid(widgets "widgets is below app" "" "app/" "tests/")
forbid(widgets "OpenImageIO and JSON stay in core/io" "" "OpenImageIO/" "nlohmann/")
forbid(app "a program uses no tests" "" "tests/")
forbid(app/cli "the command line uses core only" "" "${qt}" "${gl}" "${vtk}" "render/" "widgets/"
       "app/gui/" "OpenImageIO/" "nlohmann/")

if(CLI_PROGRAM)
    execute_process(
        COMMAND ${READELF} -d ${CLI_PROGRAM} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY
    )
    string(REGEX MATCHALL "\\(NEEDED\\)[^\n]*" needed "${dynamic}")
    if(NOT needed)
        list(APPEND findings "${CLI_PROGRAM}: readelf names no library at all")
    endif()
    foreach(line IN LISTS needed)
        if(line MATCHES "lib(Qt|vtk|GL|EGL|OpenGL|epoxy|X11|xcb)")
            list(APPEND findings "ghostlight-cli links ${line}")
        endif()
    endforeach()
endif()

if(findings)
    list(JOIN findings "\n  " text)
    message(FATAL_ERROR "Against the architecture:\n  ${text}")
endif()
