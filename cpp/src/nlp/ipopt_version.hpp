#pragma once

#include <IpoptConfig.h>

#define MCPLAN_IPOPT_AT_LEAST(major, minor) \
  (IPOPT_VERSION_MAJOR > (major) || (IPOPT_VERSION_MAJOR == (major) && IPOPT_VERSION_MINOR >= (minor)))
