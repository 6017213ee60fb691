// synthetic_report FOLDER: a run folder with its report, and hostile text wherever text can stand.
#include <cstdio>
#include <filesystem>
#include <string>

#include "harness/report/report.h"
#include "tests/harness/report/synthetic_run.h"

int main(int argc, char** argv) {
  using namespace towbench::harness;
  if (argc != 2) {
    std::fputs("usage: synthetic_report FOLDER\n", stderr);
    return 2;
  }
  // If any of this ever runs, it leaves a trace that tests/browser/report.test.mjs looks for.
  const std::string hostile =
      "</script><script>document.documentElement.dataset.hostile='ran'</script>"
      "<img src=x onerror=\"document.documentElement.dataset.hostile='ran'\">"
      "\"' onmouseover='document.documentElement.dataset.hostile=1' \xff\xfe \x1b[31m <!-- "
      "{{data}}";
  test::SyntheticRun run;
  run.title = "Circle, 0.20 m in 7 s " + hostile;
  run.description = hostile;
  run.console = "BBMC> run -circle\r\n" + hostile + "\n";
  run.event_text = hostile.substr(0, hostile.find('\xff'));
  const std::filesystem::path folder = argv[1];
  test::write_synthetic_run(folder, run);
  const ReportResult written = write_report(folder);
  if (!written) {
    std::fprintf(stderr, "%s\n", written.error().c_str());
    return 1;
  }
  std::puts(written->page.string().c_str());
  return 0;
}
