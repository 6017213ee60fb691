// The verbs of towbench-study, each as those of harness/commands/command.h.
#pragma once

namespace CLI {
class App;
}

namespace towbench::study {

// `exit_code` outlives the parse.
void add_diagnose(CLI::App& app, int& exit_code);
void add_identify(CLI::App& app, int& exit_code);
void add_results(CLI::App& app, int& exit_code);
void add_tow(CLI::App& app, int& exit_code);
// The bench's `validate` comes here where settings of the study are among the files.
void add_validate_all(CLI::App& app, int& exit_code);

}  // namespace towbench::study
