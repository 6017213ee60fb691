#include "bbmc/application/commands/parse.h"

#include <array>

#include "bbmc/application/commands/command_table.h"
#include "bbmc/application/commands/machine_axes.h"
#include "bbmc/application/console/decimal.h"

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// The text of each option, as found on the line; null data where it was not given.
using Texts = std::array<std::string_view, kMaxOptions>;

std::size_t option_named(const CommandSpec& command, std::string_view word, bool& short_name) {
  for (std::size_t i = 0; i < command.options.size(); ++i) {
    const OptionSpec& option = command.options[i];
    short_name = !option.short_name.empty() && option.short_name == word;
    if (!option.is_positional() && (option.name == word || short_name)) {
      return i;
    }
  }
  return kMaxOptions;
}

// The first positional argument that has no text yet.
std::size_t next_positional(const CommandSpec& command, const Configuration& configuration,
                            const Texts& texts) {
  for (std::size_t i = 0; i < command.options.size(); ++i) {
    const OptionSpec& option = command.options[i];
    if (option.is_positional() && applies(option, configuration) && texts[i].data() == nullptr) {
      return i;
    }
  }
  return kMaxOptions;
}

bool looks_like_option(std::string_view word) noexcept {
  if (word.size() < 2 || word.front() != '-') {
    return false;
  }
  const char second = word[1];
  return second != '.' && (second < '0' || second > '9');
}

// Gives each word to its option. `why` is written on refusal.
ErrorCode sort_words(const CommandSpec& command, const Tokens& words,
                     const Configuration& configuration, Texts& texts, TextWriter& why) noexcept {
  std::size_t i = 0;
  const auto take = [&](std::size_t option, std::string_view name) {
    if (option >= command.options.size() || i == words.size()) {
      why.text(name).text(" needs a value");
      return ErrorCode::kRequestMissingArgument;
    }
    if (texts[option].data() != nullptr) {
      why.text(name).text(" is given twice");
      return ErrorCode::kRequestBadArgument;
    }
    texts[option] = words[i++];
    return ErrorCode::kNone;
  };
  while (i < words.size()) {
    const std::string_view word = words[i];
    bool short_name = false;
    const std::size_t named = option_named(command, word, short_name);
    if (named == kMaxOptions) {
      const std::size_t positional = next_positional(command, configuration, texts);
      if (positional == kMaxOptions || looks_like_option(word)) {
        why.text(looks_like_option(word) ? "no such option: " : "one argument too many: ")
            .text(word);
        return ErrorCode::kRequestBadArgument;
      }
      texts[positional] = word;
      ++i;
      continue;
    }
    const OptionSpec& option = command.options[named];
    // A flag's text is its own name.
    i += option.kind == OptionKind::kFlag ? 0U : 1U;
    if (const ErrorCode code = take(named, word); code != ErrorCode::kNone) {
      return code;
    }
    if (short_name && option.short_name_takes_two) {
      if (const ErrorCode code = take(named + 1, word); code != ErrorCode::kNone) {
        return code;
      }
    }
  }
  return ErrorCode::kNone;
}

// The index of `text` among names separated by |, or -1.
int choice_index(std::string_view choices, std::string_view text) noexcept {
  for (int index = 0;; ++index) {
    const std::size_t bar = choices.find('|');
    if (choices.substr(0, bar) == text) {
      return index;
    }
    if (bar == std::string_view::npos) {
      return -1;
    }
    choices.remove_prefix(bar + 1);
  }
}

double counts_per_m(const CommandSpec& command, const OptionSpec& option,
                    const Configuration& configuration, const Arguments& arguments) noexcept {
  switch (option.counts_of) {
    case CountsOf::kNoAxis:
      return 0;
    case CountsOf::kY:
      return configuration.axes[core::Axis::kY].counts_per_m();
    case CountsOf::kX:
      return configuration.axes[core::Axis::kX].counts_per_m();
    case CountsOf::kDof:
      break;
  }
  for (std::size_t i = 0; i < command.options.size(); ++i) {
    if (command.options[i].kind == OptionKind::kAxis) {
      return configuration.axes[arguments.axis(i)].counts_per_m();
    }
  }
  return 0;
}

double default_of(const CommandSpec& command, const OptionSpec& option,
                  const Configuration& configuration, const Arguments& arguments) noexcept {
  if (option.default_text.empty()) {
    return option.default_value;
  }
  return parse_quantity(option.default_text, option.dimension, option.bare_unit,
                        counts_per_m(command, option, configuration, arguments))
      .value_or(option.default_value);
}

// Out of range or not a value at all: the same sentence.
ErrorCode refuse(ErrorCode code, const OptionSpec& option, std::string_view text,
                 TextWriter& why) noexcept {
  why.text(option.name).text(" ").text(text).text(" is not ");
  write_allowed(why, option);
  return code;
}

bool is_bbmc_unit(const OptionSpec& option, std::string_view text) noexcept {
  const auto number = parse_decimal(text);
  return number && (number->rest.empty() ? option.bare_unit : number->rest) == kBbmcGainUnit;
}

}  // namespace

ErrorCode find_command(const Tokens& words, FoundCommand& found, TextWriter& why) noexcept {
  const CommandSpec* fallback = nullptr;
  bool known_word = false;
  std::size_t sub_at = 0;
  for (const CommandSpec& spec : command_table()) {
    if (spec.word != words[0]) {
      continue;
    }
    known_word = true;
    fallback = spec.is_default || spec.sub.empty() ? &spec : fallback;
    // -trapez may stand anywhere, `print` only behind its command.
    const std::size_t last = spec.sub.starts_with('-') ? words.size() : 2;
    for (std::size_t i = 1; i < last && i < words.size() && !spec.sub.empty(); ++i) {
      if (words[i] == spec.sub) {
        if (found.spec != nullptr) {
          why.text(found.spec->sub).text(" and ").text(spec.sub).text(" exclude each other");
          found.spec = nullptr;
          return ErrorCode::kRequestBadArgument;
        }
        found.spec = &spec;
        sub_at = i;
        break;
      }
    }
  }
  if (!known_word) {
    why.text(words[0]).text("; `help` lists what there is");
    return ErrorCode::kRequestUnknown;
  }
  found.spec = found.spec == nullptr ? fallback : found.spec;
  if (found.spec == nullptr) {
    why.text(words[0]).text(" what? `help ").text(words[0]).text("` lists what there is");
    return words.size() < 2 ? ErrorCode::kRequestMissingArgument : ErrorCode::kRequestUnknown;
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (i != sub_at) {
      static_cast<void>(found.arguments.push_back(words[i]));
    }
  }
  return ErrorCode::kNone;
}

ErrorCode parse_option(const CommandSpec& command, std::size_t index, std::string_view text,
                       const Configuration& configuration, Arguments& arguments,
                       TextWriter& why) noexcept {
  const OptionSpec& option = command.options[index];
  switch (option.kind) {
    case OptionKind::kFlag:
      arguments.set(index, 1);
      return ErrorCode::kNone;
    case OptionKind::kAxis:
    case OptionKind::kChoice: {
      const bool by_number = option.kind == OptionKind::kAxis && (text == "1" || text == "2");
      const int choice =
          by_number ? text[0] - '1'
                    : choice_index(option.kind == OptionKind::kAxis ? "y|x" : option.choices, text);
      if (choice < 0) {
        return refuse(ErrorCode::kRequestBadArgument, option, text, why);
      }
      arguments.set(index, choice);
      return option.kind == OptionKind::kAxis
                 ? must_exist(configuration, arguments.axis(index), why)
                 : ErrorCode::kNone;
    }
    case OptionKind::kWhole: {
      const auto value = parse_integer(text);
      if (!value) {
        return refuse(ErrorCode::kRequestBadArgument, option, text, why);
      }
      if (!option.range.contains(static_cast<double>(*value))) {
        return refuse(ErrorCode::kRequestOutOfRange, option, text, why);
      }
      arguments.set(index, static_cast<double>(*value));
      return ErrorCode::kNone;
    }
    case OptionKind::kQuantity:
      break;
  }
  const auto value = parse_quantity(text, option.dimension, option.bare_unit,
                                    counts_per_m(command, option, configuration, arguments));
  if (!value) {
    return refuse(value.error(), option, text, why);
  }
  if (!option.range.contains(*value)) {
    return refuse(ErrorCode::kRequestOutOfRange, option, text, why);
  }
  arguments.set(index, *value, is_bbmc_unit(option, text));
  return ErrorCode::kNone;
}

ErrorCode parse_arguments(const CommandSpec& command, const Tokens& words,
                          const Configuration& configuration, Arguments& arguments,
                          TextWriter& why) noexcept {
  core::check(command.options.size() <= kMaxOptions);
  Texts texts{};
  if (const ErrorCode code = sort_words(command, words, configuration, texts, why);
      code != ErrorCode::kNone) {
    return code;
  }
  // Axes first: the other values may be in their counts.
  for (const bool axes : {true, false}) {
    for (std::size_t i = 0; i < command.options.size(); ++i) {
      const OptionSpec& option = command.options[i];
      if ((option.kind == OptionKind::kAxis) != axes) {
        continue;
      }
      if (texts[i].data() == nullptr) {
        if (option.presence == Presence::kRequired && applies(option, configuration)) {
          why.text(option.name).text(": ");
          write_allowed(why, option);
          return ErrorCode::kRequestMissingArgument;
        }
        arguments.set_default(i, default_of(command, option, configuration, arguments));
        if (axes && option.presence == Presence::kDefault) {
          if (const ErrorCode code = must_exist(configuration, arguments.axis(i), why);
              code != ErrorCode::kNone) {
            return code;
          }
        }
        continue;
      }
      const ErrorCode code = parse_option(command, i, texts[i], configuration, arguments, why);
      if (code != ErrorCode::kNone) {
        return code;
      }
    }
  }
  return ErrorCode::kNone;
}

void write_value(TextWriter& writer, const OptionSpec& option, double value) noexcept {
  if (option.kind == OptionKind::kQuantity) {
    write_quantity(writer, value, option.dimension);
    return;
  }
  if (option.kind == OptionKind::kWhole) {
    writer.compact(value, 0);
    return;
  }
  std::string_view choices = option.kind == OptionKind::kAxis ? "y|x" : option.choices;
  for (int skip = static_cast<int>(value); skip > 0; --skip) {
    choices.remove_prefix(choices.find('|') + 1);
  }
  writer.text(choices.substr(0, choices.find('|')));
}

void write_allowed(TextWriter& writer, const OptionSpec& option) noexcept {
  switch (option.kind) {
    case OptionKind::kFlag:
      return;
    case OptionKind::kAxis:
      writer.text("y (or 1), x (or 2)");
      return;
    case OptionKind::kChoice:
      writer.text(option.choices);
      return;
    case OptionKind::kWhole:
    case OptionKind::kQuantity:
      break;
  }
  const core::Range everything = core::any_finite();
  const bool bounded_below = option.range.min > everything.min;
  const bool bounded_above = option.range.max < everything.max;
  if (!bounded_below && !bounded_above) {
    writer.text("a number");
    if (!display_unit(option.dimension).name.empty()) {
      writer.text(" in ").text(display_unit(option.dimension).name);
    }
    return;
  }
  if (bounded_below) {
    writer.text(option.range.min_is_allowed ? "" : "above ");
    write_value(writer, option, option.range.min);
  }
  if (bounded_above) {
    writer.text(!bounded_below ? "at most " : option.range.min_is_allowed ? " .. " : " to ");
    write_value(writer, option, option.range.max);
  } else if (option.range.min_is_allowed) {
    writer.text(" or more");
  }
}

}  // namespace towbench::bbmc
