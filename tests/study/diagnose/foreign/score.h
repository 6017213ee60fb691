// Right or wrong, by the names that the physics calls the same, and tables of it.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "tests/study/diagnose/foreign/answer.h"

namespace towbench::tests::foreign {

// What was hidden, as the score needs it.
struct Key {
  std::string name;
  std::vector<std::string> right;
  std::vector<std::string> beside;
};

enum class Outcome {
  kRight,    // all that was hidden is named and nothing else; outside: unexplained, nothing named
  kPartly,   // one of two, and nothing else
  kMissed,   // nothing named
  kExtra,    // all named, and something that is not there
  kFalse,    // something that is not there instead
  kRefused,  // the data
  kUnjudged  // not diagnosed
};
inline constexpr std::array<const char*, 7> kOutcomes{"right", "partly",  "missed",  "extra",
                                                      "false", "refused", "unjudged"};

// A cause that was named, with its p-value; a parameter that moved has none.
struct Said {
  double p_value = 1;
  bool wrong = false;
};

struct Judged {
  Outcome outcome = Outcome::kUnjudged;
  std::vector<std::string> false_names;
  std::vector<Said> said;
};

// A class of more names than this is no answer.
inline constexpr std::size_t kMostNames = 5;

[[nodiscard]] Judged judge(const std::vector<Key>& hidden, bool is_outside, const Answer& answer);

// Counts by rows of a table.
class Tally {
 public:
  void add(const std::string& table, const std::string& row, const Judged& judged,
           bool is_unexplained);
  // How often what was named with a p-value is wrong.
  void add(const std::vector<Said>& said);
  [[nodiscard]] std::string words() const;

 private:
  struct Row {
    std::array<int, kOutcomes.size()> counts{};
    int all = 0;
    int unexplained = 0;
    std::map<std::string, int> false_names;
  };
  std::map<std::string, std::map<std::string, Row>> tables_;
  std::vector<Said> said_;
};

}  // namespace towbench::tests::foreign
