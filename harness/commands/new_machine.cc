// towbench new-machine: rig, plant, controller and first experiment of a one-axis machine.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "harness/checks/check.h"
#include "harness/commands/command.h"
#include "harness/commands/option_checks.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/fixtures/table_reader.h"
#include "harness/new_machine/disagreement.h"
#include "harness/new_machine/machine_files.h"

namespace towbench::harness {
namespace {

struct NewMachine {
  MachineData data;
  std::string out;
};

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> names{"screw", "belt", "chain", "rack"};
  return names;
}
const std::vector<std::string>& switches() {
  static const std::vector<std::string> names{"both", "min", "max", "none"};
  return names;
}

[[noreturn]] void refuse(std::string_view option, std::string given, std::string allowed) {
  throw FixtureError({.file = "command line", .key = fmt::format("--{}", option)}, std::move(given),
                     std::move(allowed));
}

bool asks_a_person() {
  return isatty(STDIN_FILENO) == 1;
}

// One line of a person's answer; refused at the end of the input.
std::string answer_to(std::string_view option, const std::string& question) {
  std::fprintf(stderr, "%s: ", question.c_str());
  std::string line;
  if (!std::getline(std::cin, line)) {
    refuse(option, "nothing", question);
  }
  return line;
}

void choose(std::string_view option, const std::vector<std::string>& names, std::string& choice) {
  const auto question = fmt::format("{} ({})", option, fmt::join(names, ", "));
  if (choice.empty() && asks_a_person()) {
    choice = answer_to(option, question);
  }
  if (std::find(names.begin(), names.end(), choice) == names.end()) {
    refuse(option, choice.empty() ? "nothing" : choice,
           fmt::format("one of {}", fmt::join(names, ", ")));
  }
}

double number_from(const MachineNumber& number, const std::string& text) {
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value)) {
    refuse(number.option, text, "a number");
  }
  return value;
}

// Asks only for what is needed: what has a value otherwise is taken so.
void complete(const MachineNumber& number, const std::string& kind, std::optional<double>& value) {
  if (!has_number(kind, number)) {
    if (value) {
      refuse(number.option, fmt::format("a number that a {} does not have", kind),
             fmt::format("only with {}", number.of_kinds));
    }
    return;
  }
  const auto asked =
      fmt::format("{} ({}), {}", number.option, describe(number.range), number.meaning);
  if (!value && !number.otherwise) {
    if (!asks_a_person()) {
      refuse(number.option, "nothing", asked);
    }
    value = number_from(number, answer_to(number.option, asked));
  }
  if (value && !number.range.contains(*value)) {
    refuse(number.option, fmt::format("{}", *value), asked);
  }
}

void complete(MachineData& data) {
  choose("transmission", kinds(), data.kind);
  for (std::size_t i = 0; i < data.numbers.size(); ++i) {
    complete(machine_numbers()[i], data.kind, data.numbers[i]);
  }
  choose("switches", switches(), data.switches);
  if (const auto sentence = inconsistency(data); !sentence.empty()) {
    throw FixtureError({.file = "command line"}, "numbers that do not go together", sentence);
  }
}

void write(const std::filesystem::path& folder, const std::vector<MachineFile>& files) {
  for (const auto& file : files) {
    if (std::filesystem::exists(folder / file.name)) {
      refuse("out", (folder / file.name).string() + ", which is there", "a folder without it");
    }
  }
  std::filesystem::create_directories(folder);
  for (const auto& file : files) {
    std::ofstream stream(folder / file.name, std::ios::binary);
    stream << file.text;
    stream.flush();
    if (!stream) {
      throw std::runtime_error("cannot write " + (folder / file.name).string());
    }
    std::printf("%s\n", (folder / file.name).c_str());
  }
}

// Refused, if at all, before anything is written.
void try_to_read(const std::filesystem::path& folder, const std::vector<MachineFile>& files) {
  for (const auto& file : files) {
    const auto parsed = FixtureFile::parse(file.text, folder / file.name);
    if (file.name == "plant.toml") {
      (void)read_plant(parsed);
    } else if (file.name == "controller.toml") {
      (void)read_controller(parsed);
    }
  }
}

int execute(NewMachine machine) {
  complete(machine.data);
  const std::filesystem::path folder(machine.out);
  const auto files = files_of(machine.data);
  try_to_read(folder, files);
  write(folder, files);
  const auto read = load_experiment(folder / "experiment.toml");
  for (const auto& sentence : disagreements(read.rig.parameters, read.controller.configuration)) {
    std::printf("warning: %s\n", sentence.c_str());
  }
  std::printf("next: towbench validate %s, then towbench run it\n",
              (folder / "experiment.toml").c_str());
  return kExitPass;
}

}  // namespace

void add_new_machine(CLI::App& app, int& exit_code) {
  auto machine = std::make_shared<NewMachine>();
  auto* verb = app.add_subcommand(
      "new-machine", "write rig, plant, controller and first experiment of a one-axis machine");
  verb->add_option("--out", machine->out,
                   "folder for plant.toml, rig.toml, controller.toml and "
                   "experiment.toml; none of them may be there")
      ->required()
      ->check(folder_to_write());
  verb->add_option("--name", machine->data.name, "of the machine")
      ->check(CLI::Validator(
          [](const std::string& text) {
            const auto good = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-");
            return text.empty() || good != std::string::npos
                       ? "\"" + text + "\" is no name of a-z, 0-9 and -"
                       : std::string();
          },
          ""))
      ->capture_default_str();
  verb->add_option("--transmission", machine->data.kind, "screw, belt, chain or rack");
  verb->add_option("--switches", machine->data.switches,
                   "end-stop sensors that there are: both, min, max or none");
  for (std::size_t i = 0; i < machine->data.numbers.size(); ++i) {
    const auto& number = machine_numbers()[i];
    verb->add_option(
        "--" + std::string(number.option), machine->data.numbers[i],
        std::string(number.meaning) + (number.otherwise && *number.otherwise >= 0
                                           ? fmt::format("; {} unless given", *number.otherwise)
                                           : ""));
  }
  verb->footer(
      "Example: towbench new-machine --out stage --transmission screw --lead-m 5e-3 "
      "--encoder-lines 2000 ...\nWhat is needed and not given is asked for at a terminal. "
      "Guide: docs/guide/your-machine.md");
  verb->callback([machine, &exit_code] { exit_code = execute(*machine); });
}

}  // namespace towbench::harness
