// The verbs as processes: exit codes and what they print.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/proof/run_manifest.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

using Output = tests::ProgramOutput;

Output towbench(const std::string& arguments) {
  return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " " + arguments);
}

Output bash(const std::string& script) {
  return tests::output_of("bash -c '" + script + "'");
}

// As the program lists them, without those of other programs.
std::vector<std::string> verbs() {
  const std::set<std::string> elsewhere{"panel", "identify", "tow", "results", "diagnose"};
  std::istringstream lines(towbench("--help").text);
  std::vector<std::string> found;
  std::string line;
  while (std::getline(lines, line) && line != "Subcommands:") {
  }
  while (std::getline(lines, line) && !line.empty()) {
    std::string verb;
    std::istringstream(line) >> verb;
    if (!elsewhere.contains(verb)) found.push_back(verb);
  }
  return found;
}

TEST(CommandLine, EveryVerbHasHelpWithAnExample) {
  ASSERT_GE(verbs().size(), 15);
  for (const std::string& verb : verbs()) {
    const auto help = towbench(verb + " --help");
    EXPECT_EQ(help.code, 0) << verb;
    EXPECT_THAT(help.text, HasSubstr("Example: towbench " + verb));
  }
}

TEST(CommandLine, BadArgumentsAreTwo) {
  for (const char* arguments :
       {"", "fly", "run", "run trapezoid-400 --carrier pigeon", "run no-such-experiment",
        "run circle --seed x", "replay /tmp", "control --controller x",
        "emulate --rig x --listen tcp:1", "validate no/such/file.toml"}) {
    EXPECT_EQ(towbench(arguments).code, kExitBadInput) << arguments;
  }
}

TEST(CommandLine, AMisspeltVerbIsToldOnOneLine) {
  const auto output = towbench("replya");
  EXPECT_EQ(output.code, kExitBadInput);
  EXPECT_THAT(output.text, HasSubstr("no verb 'replya'; did you mean replay?"));
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1);
}

TEST(CommandLine, BashCompletesVerbsOptionsAndExperiments) {
  const std::string script = "source <(" + tests::quoted(TOWBENCH_PROGRAM) + " completion); ";
  const auto completes = [&](const std::string& words, int at) {
    return script + "COMP_WORDS=(towbench " + words + "); COMP_CWORD=" + std::to_string(at) +
           "; _towbench; echo \"<${COMPREPLY[*]}>\"";
  };
  EXPECT_THAT(bash(completes("rep", 1)).text, EndsWith("<replay report>\n"));
  EXPECT_THAT(bash(completes("run puls", 2)).text, EndsWith("<pulses>\n"));
  EXPECT_THAT(bash(completes("run --car", 2)).text, EndsWith("<--carrier>\n"));
  EXPECT_THAT(bash(completes("nonsense x", 2)).text, EndsWith("<>\n"));
}

TEST(CommandLine, AMisspeltExperimentIsToldOnOneLine) {
  const auto output = towbench("run circel");
  EXPECT_THAT(output.text, HasSubstr("did you mean circle?"));
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1);
}

TEST(CommandLine, ARunPrintsItsTableAndLastTheReport) {
  const TemporaryFixtures files;
  const auto output = towbench("run pulses --out " + files.folder().string());
  EXPECT_EQ(output.code, kExitPass) << output.text;
  EXPECT_THAT(output.text, HasSubstr("PASS     pulses"));
  EXPECT_THAT(output.text, EndsWith("report.html\n"));
}

TEST(CommandLine, JsonIsTheResultWithItsFolderAndFactor) {
  const TemporaryFixtures files;
  const auto output = towbench("run pulses --json --no-report --out " + files.folder().string());
  const auto result = nlohmann::json::parse(output.text);
  EXPECT_EQ(result.at("verdict"), "PASS");
  EXPECT_GT(result.at("real_time_factor").get<double>(), 1.0);
  EXPECT_TRUE(std::filesystem::exists(result.at("folder").get<std::string>() + "/log.csv"));
}

TEST(CommandLine, ReplaySaysIdenticalAndNamesTheFirstLineThatIsNot) {
  const TemporaryFixtures files;
  const auto run = towbench("run pulses --json --no-report --out " + files.folder().string());
  const std::filesystem::path folder =
      nlohmann::json::parse(run.text).at("folder").get<std::string>();
  const auto same = towbench("replay " + folder.string());
  EXPECT_EQ(same.code, kExitPass) << same.text;
  auto log = contents_of(folder / "log.csv");
  const auto line_3 = log.find('\n', log.find('\n') + 1) + 1;
  log[line_3] = '7';
  std::ofstream(folder / "log.csv", std::ios::binary) << log;
  const auto changed = towbench("replay " + folder.string());
  EXPECT_EQ(changed.code, kExitInvalid);
  EXPECT_THAT(changed.text, HasSubstr("log.csv holds other bytes than were recorded"));
  write_manifest(folder);  // on purpose, with the key
  const auto other = towbench("replay " + folder.string());
  EXPECT_EQ(other.code, kExitFail);
  EXPECT_THAT(other.text, HasSubstr("log.csv differs at line 3"));
}

TEST(CommandLine, APipedConsoleSessionRunsLineByLine) {
  Output output;
  const std::string command = std::string("printf 'status\\nnonsense\\nquit\\n' | ") +
                              tests::quoted(TOWBENCH_PROGRAM) +
                              " control --fast --controller fixtures/controllers/bbmc-tuned.toml"
                              " --rig fixtures/rigs/macs-nominal.toml 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> bytes{};
  for (std::size_t count = 0; (count = fread(bytes.data(), 1, bytes.size(), pipe)) > 0;) {
    output.text.append(bytes.data(), count);
  }
  EXPECT_EQ(WEXITSTATUS(pclose(pipe)), 0) << output.text;
  EXPECT_THAT(output.text, HasSubstr("ok"));
  EXPECT_THAT(output.text, HasSubstr("error 200"));
}

}  // namespace
}  // namespace towbench::harness
