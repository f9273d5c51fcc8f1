#pragma once

namespace mcplan {

/// Whether this process is a child of fork() without exec, made after the library was loaded. GNU's OpenMP waits for
/// threads of its parent there, for ever; whoever would start threads works alone instead.
bool forked();

}  // namespace mcplan
