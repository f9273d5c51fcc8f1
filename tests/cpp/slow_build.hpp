#pragma once

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSlowBuild = true;  ///< the sanitizers cost a factor of ten to thirty: fewer cases there
#else
constexpr bool kSlowBuild = false;
#endif
