# Ipopt::Ipopt, from Debian's coinor-libipopt-dev or any other installation (set Ipopt_ROOT).
# Not by pkg-config: Debian's ipopt.pc asks for libraries whose development links the package does not bring.
find_path(Ipopt_INCLUDE_DIR IpIpoptApplication.hpp PATH_SUFFIXES coin coin-or)
find_library(Ipopt_LIBRARY NAMES ipopt)
if(Ipopt_INCLUDE_DIR AND EXISTS "${Ipopt_INCLUDE_DIR}/IpoptConfig.h")
  file(STRINGS "${Ipopt_INCLUDE_DIR}/IpoptConfig.h" Ipopt_VERSION_LINE REGEX "define IPOPT_VERSION ")
  string(REGEX REPLACE ".*\"(.*)\".*" "\\1" Ipopt_VERSION "${Ipopt_VERSION_LINE}")
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Ipopt REQUIRED_VARS Ipopt_LIBRARY Ipopt_INCLUDE_DIR VERSION_VAR Ipopt_VERSION
                                  REASON_FAILURE_MESSAGE "install it (Debian: apt-get install coinor-libipopt-dev)")
if(Ipopt_FOUND AND NOT TARGET Ipopt::Ipopt)
  add_library(Ipopt::Ipopt UNKNOWN IMPORTED)
  set_target_properties(
    Ipopt::Ipopt
    PROPERTIES IMPORTED_LOCATION "${Ipopt_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${Ipopt_INCLUDE_DIR}"
               # Ipopt 3.11 chooses between <cstddef> and nothing by a macro of its own configuration.
               INTERFACE_COMPILE_DEFINITIONS HAVE_CSTDDEF)
endif()
mark_as_advanced(Ipopt_INCLUDE_DIR Ipopt_LIBRARY)
