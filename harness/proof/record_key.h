// The key of this user on this machine, under which run folders are recorded.
//
// It lies in the user's state folder ($XDG_STATE_HOME, else ~/.local/state), never in a run folder:
// who changes a record and its manifest alike must also go and read the key, which no slip does.
#pragma once

#include <optional>
#include <string>

namespace towbench::harness {

// Made on first use, readable by its user only. Nothing where there is no place to keep one.
[[nodiscard]] std::optional<std::string> record_key();

// Names a key without telling it.
[[nodiscard]] std::string name_of_key(const std::string& key);

}  // namespace towbench::harness
