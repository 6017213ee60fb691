// The verb of towbench-panel, as those of harness/commands/command.h.
#pragma once

namespace CLI {
class App;
}

namespace towbench::harness {

// `exit_code` outlives the parse.
void add_panel(CLI::App& app, int& exit_code);

}  // namespace towbench::harness
