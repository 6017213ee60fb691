// The verbs of towbench. Each adds itself to the command line and, when it is chosen, runs and says
// with which code the process ends (RUN-1).
#pragma once

#include <span>

namespace CLI {
class App;
}

namespace towbench::harness {

// `exit_code` outlives the parse.
void add_demo(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_list(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_emulate(CLI::App& app, int& exit_code);
void add_control(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);
void add_campaign(CLI::App& app, int& exit_code);
void add_falsify(CLI::App& app, int& exit_code);
void add_conform(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_new_machine(CLI::App& app, int& exit_code);
void add_export_fmu(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_completion(CLI::App& app, int& exit_code);
// Start towbench-study and towbench-panel, which lie beside this program.
void add_identify_elsewhere(CLI::App& app, int& exit_code);
void add_panel_elsewhere(CLI::App& app, int& exit_code);

using AddVerb = void (*)(CLI::App&, int&);

// A command line of these verbs. Never throws.
[[nodiscard]] int run_command_line(std::span<const AddVerb> verbs, int argc, char** argv) noexcept;

}  // namespace towbench::harness
