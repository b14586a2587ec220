# Everything the project takes from outside; packages.txt lists the Debian packages.

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(pugixml REQUIRED)
find_package(CLI11 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(OpenImageIO REQUIRED)
find_package(Ceres REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)

# Debian's OpenImageIO names OpenCV's header folder whether or not it is installed, and CMake
# refuses a target whose folders do not exist.
get_target_property(folders OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
set(existing)
foreach(folder IN LISTS folders)
    if(EXISTS "${folder}")
        list(APPEND existing "${folder}")
    endif()
endforeach()
set_target_properties(
    OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${existing}"
)

# Before version 0.8 the target has no namespace.
if(NOT TARGET yaml-cpp::yaml-cpp)
    add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()

if(GHOSTLIGHT_BUILD_GUI)
    find_package(Qt6 6.4 REQUIRED COMPONENTS Widgets OpenGL OpenGLWidgets Svg)
    # Makes the catalogues of translated texts; Debian keeps it beside Qt's other tools.
    find_program(
        GHOSTLIGHT_LRELEASE NAMES lrelease lrelease-qt6 lrelease6
        HINTS ${QT6_INSTALL_PREFIX}/${QT6_INSTALL_BINS} /usr/lib/qt6/bin
        NO_DEFAULT_PATH REQUIRED
    )
    # Debian's VTK refers to MPI::MPI_C without looking for it.
    find_package(MPI REQUIRED COMPONENTS C)
    find_package(
        VTK 9.1 REQUIRED
        COMPONENTS
            CommonCore
            CommonDataModel
            CommonTransforms
            FiltersCore
            FiltersGeneral
            FiltersSources
            RenderingCore
            RenderingOpenGL2
            RenderingFreeType
            RenderingAnnotation
            InteractionStyle
            ChartsCore
            ViewsContext2D
            RenderingContext2D
            RenderingContextOpenGL2
            IOImage
    )
endif()

if(GHOSTLIGHT_BUILD_TESTS)
    find_package(GTest REQUIRED)
    find_package(benchmark REQUIRED)
    if(GHOSTLIGHT_BUILD_GUI)
        find_package(Qt6 6.4 REQUIRED COMPONENTS Test)
    endif()
endif()
