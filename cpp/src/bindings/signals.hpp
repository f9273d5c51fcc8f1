#pragma once

#include <functional>
#include <optional>
#include <type_traits>
#include <utility>

#include "bindings.hpp"
#include "mcplan/base/logging.hpp"

namespace mcplan::bindings {

/// What signals ask of the solve that runs in this thread. Python tells of a signal once, by running its handler, and a
/// solve asks at many places: what a handler raised is kept here, so that every later question is answered yes and the
/// exception is raised when the solve has ended, however it ended. A handler that raises nothing stops nothing.
/// Python runs handlers in its main thread alone: in other threads a watch sees nothing.
class SignalWatch {
 public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// StopRequest of every solve: whether a handler has raised since the watch of this thread began.
  static bool stop();

  /// Keeps an exception that was raised in Python code which the solve called; false: there is no watch to keep it.
  static bool keep(const py::error_already_set& error);

  /// The same for a KeyboardInterrupt alone; whatever cannot be kept is thrown on.
  static void keep_interrupt(const py::error_already_set& error);

  /// With the GIL: runs handlers of signals that no one has asked for yet.
  void look();

  bool asked() const { return raised_.has_value(); }

  /// Raises what was kept: mcplan.errors.Interrupted with `result` for a KeyboardInterrupt, anything else as it is.
  [[noreturn]] void raise(py::handle result);

 private:
  SignalWatch* outer_;
  std::optional<py::error_already_set> raised_;
};

/// A function of the user's that a solve calls, during which Python may run handlers too: a KeyboardInterrupt from
/// there ends the solve as others do.
template <class... Arguments>
std::function<void(Arguments...)> watched(std::function<void(Arguments...)> function) {
  return [function = std::move(function)](Arguments... arguments) {
    try {
      function(arguments...);
    } catch (const py::error_already_set& error) {
      SignalWatch::keep_interrupt(error);
    }
  };
}

template <class Options, class = void>
struct HasWatch : std::false_type {};
template <class Options>
struct HasWatch<Options, std::void_t<decltype(Options::watch)>> : std::true_type {};

/// The options of a planner, whose solves then run in interruptible().
template <class Options>
Options watched(Options options) {
  options.stop = SignalWatch::stop;
  if (options.logger) options.logger = watched(std::move(options.logger));
  if constexpr (HasWatch<Options>::value)
    if (options.watch) options.watch = watched(std::move(options.watch));
  return options;
}

/// Runs a solve without the GIL and raises afterwards what signals asked meanwhile, the result attached.
template <class Solve>
auto interruptible(Solve&& solve) {
  SignalWatch watch;
  const auto run = [&] {
    try {
      return without_gil(solve);
    } catch (...) {
      if (watch.asked()) watch.raise(py::none());
      throw;
    }
  };
  auto result = run();
  watch.look();
  if (watch.asked()) watch.raise(py::cast(std::move(result)));
  return result;
}

}  // namespace mcplan::bindings
