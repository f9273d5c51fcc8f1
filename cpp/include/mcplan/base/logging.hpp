#pragma once

#include <functional>
#include <string>

namespace mcplan {

enum class LogLevel { debug, info, warning };

/// Receives one line without a newline. The library never prints: no logger, no output.
using Logger = std::function<void(LogLevel, const std::string&)>;

/// Polled once an iteration; returning true ends the solve with Status::interrupted.
using StopRequest = std::function<bool()>;

}  // namespace mcplan
