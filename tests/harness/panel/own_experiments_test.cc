// A page may start what lies in the working folder, and nothing else.
#include "harness/panel/own_experiments.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fixtures/fixture_error.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

void put(const fs::path& file, const char* text = "schema = 1\nrig = \"x\"\n[[console]]\n") {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(OwnExperiments, AreTheExperimentFilesBelowTheFolderAndNoOthers) {
  const TemporaryFixtures files;
  const auto& folder = files.folder();
  put(folder / "mine.toml");
  put(folder / "below" / "other.toml");
  put(folder / "plant.toml", "schema = 1\n[axis.y]\n");
  put(folder / ".hidden" / "a.toml");
  put(folder / "a" / "b" / "c" / "too-deep.toml");
  put(folder / "runs" / "one" / "inputs" / "copy.toml");
  fs::create_symlink("/etc", folder / "out");
  fs::create_symlink(folder / "mine.toml", folder / "link.toml");
  EXPECT_THAT(own_experiments(folder), ElementsAre("below/other.toml", "mine.toml"));
}

TEST(OwnExperiments, AShippedOneIsFoundByItsName) {
  EXPECT_EQ(experiment_named("circle").filename(), "circle.toml");
}

TEST(OwnExperiments, NothingOutsideTheFolderCanBeNamed) {
  for (const char* name : {"/etc/passwd", "../x.toml", "./../x.toml", "/dev/zero", "a/../../x.toml",
                           "fixtures/plants/macs-nominal.toml", "no-such.toml", "no-such"}) {
    EXPECT_THROW((void)experiment_named(name), FixtureError) << name;
  }
}

}  // namespace
}  // namespace towbench::harness
