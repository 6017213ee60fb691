// The one place where text becomes HTML. Whatever a run folder holds (a console transcript can hold
// anything a person or a program typed) goes through here and can only ever be read, not run.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace towbench::harness::report {

// For element content and quoted attributes. Invalid UTF-8 and control characters other than tab
// and line feed become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

// JSON for the inside of a <script> element: ASCII only, no '<', '>' or '&', so that no text in it
// can end the element.
[[nodiscard]] std::string script_json(const nlohmann::json& value);

// <hN>text</hN>, with `text` escaped.
[[nodiscard]] std::string heading(int level, std::string_view text);

// <p class="missing">: how the page says that something is not there.
[[nodiscard]] std::string missing_note(std::string_view sentence);

}  // namespace towbench::harness::report
