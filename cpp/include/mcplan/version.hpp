#pragma once

// The one place where the version stands; CMakeLists.txt and pyproject.toml read this line.
#define MCPLAN_VERSION "0.1.0"
