// A run inside the page that plays it in a browser: one file, which needs no other.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/drop/drop.hpp"
#include "tumble/trajectory/trajectory.hpp"

namespace tumble::output {

// Stands once in the page, where the run goes.
inline constexpr std::string_view k_page_marker = "<!--tumble-run-->";

inline constexpr std::size_t k_max_page_text = std::size_t{256} << 20;  // [bytes] a text; browsers hold 512 MiB in one

struct PageText {
  std::string name;
  std::string text;
};

// Throws std::invalid_argument "name: what" for a page in which the marker does not stand exactly once.
void check_page(std::string_view page, const std::string& page_name);

// The page with, in place of its marker, for each text
//   <script type="text/plain" class="tumble-file" data-name="NAME">BASE64</script>
// BASE64 [RFC 4648, one line] of the zlib stream [RFC 1950] of the text. `title`, if not empty, takes the
// place of what is in the first <title> in front of the marker. Throws as check_page, and for a text of more than
// k_max_page_text bytes.
std::string fill_page(std::string_view page, const std::string& page_name, std::string_view title,
                      const std::vector<PageText>& texts);

// The page with the record as "record.csv".
std::string to_html(const drop::Record& record, std::string_view page, const std::string& page_name);

// The page with the run as "scene.toml", "samples.csv" and, if it has contacts, "contacts.csv".
std::string to_html(const Trajectory& trajectory, std::string_view page, const std::string& page_name);

}  // namespace tumble::output
