# How every target of the project is compiled.

include(CheckCCompilerFlag)
include(CheckCSourceCompiles)

# Stops the configuration, and not each source (src/base/exact_floats.h), where a compiler's floats are none of IEEE 754.
function(talus_check_floats)
    set(CMAKE_REQUIRED_QUIET ON)
    set(CMAKE_TRY_COMPILE_CONFIGURATION ${CMAKE_BUILD_TYPE}) # with its flags
    set(CMAKE_REQUIRED_INCLUDES ${PROJECT_SOURCE_DIR}/src)
    check_c_source_compiles("#include \"base/exact_floats.h\"\nint main(void) { return 0; }" TALUS_EXACT_FLOATS)
    if(NOT TALUS_EXACT_FLOATS)
        unset(TALUS_EXACT_FLOATS CACHE)
        message(FATAL_ERROR "talus needs floats as IEEE 754 computes them: configure without -ffast-math, -Ofast, "
            "-ffinite-math-only or /fp:fast, and for 32-bit x86 with -DCMAKE_C_FLAGS='-m32 -msse2 -mfpmath=sse'")
    endif()
endfunction()

function(talus_compile_options target)
    set_target_properties(${target} PROPERTIES C_STANDARD 17 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
        # Fused multiply-adds would make results depend on the compiler, and break the antisymmetry of edge functions.
        target_compile_options(${target} PRIVATE
            -ffp-contract=off
            # Nothing reads errno, and a root that may set it has a branch beside it.
            -fno-math-errno
            $<$<COMPILE_LANGUAGE:C>:-Wall -Wextra -Wshadow -Wconversion -Wmissing-prototypes -Wstrict-prototypes
            -Wdouble-promotion -Wvla -pedantic>)
        # A project that adds talus without choosing a build type would get it unoptimised, at a tenth of its speed.
        if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
            target_compile_options(${target} PRIVATE -O2)
        endif()
        if(TALUS_WERROR)
            target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:C>:-Werror>)
        endif()
        if(TALUS_SANITIZE)
            target_compile_options(${target} PRIVATE -fsanitize=${TALUS_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
            target_link_options(${target} PRIVATE -fsanitize=${TALUS_SANITIZE})
        endif()
    endif()
    if(MINGW)
        # printf as C says (%zu). isfinite() of MinGW-w64 names a conversion to float that it never makes.
        target_compile_definitions(${target} PRIVATE __USE_MINGW_ANSI_STDIO=1)
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:C>:-Wno-float-conversion>)
    endif()
    if(MSVC)
        target_compile_options(${target} PRIVATE /experimental:c11atomics /fp:precise /utf-8)
    endif()
    if(TALUS_VALIDATE)
        target_compile_definitions(${target} PRIVATE TALUS_VALIDATE)
    endif()
endfunction()

# What reads strangers' files is compiled so that a defect ends the program instead of serving who wrote the file: canaries
# on stacks, checked copies, read-only relocations, and the command at an address that nobody knows. The core goes
# without: its inner loops are what callers pay for, and what a check has accepted is safe to query.
function(talus_harden target)
    if(NOT TALUS_HARDEN OR TALUS_SANITIZE OR NOT CMAKE_C_COMPILER_ID MATCHES "GNU|Clang" OR NOT UNIX OR APPLE)
        return()
    endif()
    # Copies are checked where the compiler optimises; distributions that set a level of their own keep it.
    target_compile_options(${target} PRIVATE -fstack-protector-strong)
    if(NOT "${CMAKE_C_FLAGS} $ENV{CPPFLAGS}" MATCHES "_FORTIFY_SOURCE")
        target_compile_options(${target} PRIVATE $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE$<SEMICOLON>-D_FORTIFY_SOURCE=2>)
    endif()
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    get_target_property(kind ${target} TYPE)
    if(kind STREQUAL "EXECUTABLE")
        target_link_options(${target} PRIVATE -pie -Wl,-z,relro,-z,now)
    endif()
endfunction()
