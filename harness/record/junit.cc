#include "harness/record/junit.h"

#include <algorithm>

#include <fmt/format.h>

namespace towbench::harness {
namespace {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // Control characters have no place in XML 1.0, escaped or not.
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

std::string test_case(std::string_view suite, const Check& check) {
  const auto name = check.window.empty() ? check.name : check.name + " over " + check.window;
  const auto open =
      fmt::format(R"(    <testcase classname="{}" name="{}")", escaped(suite), escaped(name));
  if (check.verdict == Verdict::kPass) {
    return open + "/>\n";
  }
  const char* const element = check.verdict == Verdict::kFail ? "failure" : "error";
  return fmt::format("{}>\n      <{} message=\"{}\"/>\n    </testcase>\n", open, element,
                     escaped(check.reason));
}

}  // namespace

std::string junit_xml(std::string_view suite, double wall_time_s, std::span<const Check> checks) {
  const auto count = [&](Verdict verdict) {
    return std::count_if(checks.begin(), checks.end(),
                         [&](const Check& check) { return check.verdict == verdict; });
  };
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n";
  xml += fmt::format(
      "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\">\n",
      escaped(suite), checks.size(), count(Verdict::kFail), count(Verdict::kInvalid), wall_time_s);
  for (const auto& check : checks) {
    xml += test_case(suite, check);
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

}  // namespace towbench::harness
