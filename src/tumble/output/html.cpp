#include "tumble/output/html.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <utility>

#include <zlib.h>

#include "tumble/math/format.hpp"
#include "tumble/output/csv.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::output {
namespace {

std::string zlib_stream(std::string_view text) {
  constexpr int k_level = 9;
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string stream(size, '\0');
  const int result = compress2(reinterpret_cast<Bytef*>(stream.data()), &size,
                               reinterpret_cast<const Bytef*>(text.data()), static_cast<uLong>(text.size()), k_level);
  if (result != Z_OK) throw std::bad_alloc();  // the only other failure, a short buffer, is excluded by compressBound
  stream.resize(size);
  return stream;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? k_digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&': html += "&amp;"; break;
      case '<': html += "&lt;"; break;
      case '>': html += "&gt;"; break;
      case '"': html += "&quot;"; break;
      case '\'': html += "&#39;"; break;
      default: html += c;
    }
  }
  return html;
}

std::string script_of(const PageText& text) {
  return tumble::format("<script type=\"text/plain\" class=\"tumble-file\" data-name=\"{}\">{}</script>",
                        escaped(text.name), base64(zlib_stream(text.text)));
}

void check_size(const std::string& name, std::size_t size) {
  if (size <= k_max_page_text) return;
  throw std::invalid_argument(
      tumble::format("a page for a browser holds at most {} MiB of {}, this run has more: take fewer samples",
                     k_max_page_text >> 20, name));
}

// `rows(first, last)` as in the files; ends before it takes much more memory than a page may hold.
template <class Rows>
PageText table(const std::string& name, std::string text, std::size_t count, Rows rows) {
  constexpr std::size_t k_rows_at_once = 64;
  for (std::size_t k = 0; k < count; k += k_rows_at_once) {
    text += rows(k, std::min(k + k_rows_at_once, count));
    check_size(name, text.size());
  }
  return {name, std::move(text)};
}

// The page with this title in place of its own, which stands in front of all scripts.
std::string with_title(std::string_view page, std::string_view title) {
  constexpr std::string_view k_start = "<title>", k_end = "</title>";
  const std::size_t start = page.find(k_start), end = page.find(k_end);
  if (title.empty() || start == std::string_view::npos || end == std::string_view::npos || end < start) {
    return std::string(page);
  }
  return tumble::format("{}{}{}", page.substr(0, start + k_start.size()), escaped(title), page.substr(end));
}

}  // namespace

void check_page(std::string_view page, const std::string& page_name) {
  const std::size_t first = page.find(k_page_marker);
  if (first != std::string_view::npos && page.find(k_page_marker, first + 1) == std::string_view::npos) return;
  throw std::invalid_argument(tumble::format("{}: is no page for runs: the comment {} must stand in it once, and {}",
                                             page_name, k_page_marker,
                                             first == std::string_view::npos ? "is missing" : "stands there twice"));
}

std::string fill_page(std::string_view page, const std::string& page_name, std::string_view title,
                      const std::vector<PageText>& texts) {
  check_page(page, page_name);
  std::string scripts;
  for (const PageText& text : texts) {
    check_size(text.name, text.text.size());
    scripts += script_of(text);
  }
  const std::size_t marker = page.find(k_page_marker);
  std::string filled = with_title(page.substr(0, marker), title);
  filled += scripts;
  return filled += page.substr(marker + k_page_marker.size());
}

std::string to_html(const drop::Record& record, std::string_view page, const std::string& page_name) {
  const PageText text =
      table("record.csv", csv_header(record), record.steps.size(), [&](std::size_t first, std::size_t last) {
        return csv_rows(record, static_cast<int>(first), static_cast<int>(last));
      });
  const Scene scene = drop_scene(record.trajectory.q_at(0), record.trajectory.v_at(0), record.parameters);
  return fill_page(page, page_name, scene.title, {text});
}

std::string to_html(const Trajectory& trajectory, std::string_view page, const std::string& page_name) {
  std::vector<PageText> texts = {{"scene.toml", to_toml(trajectory.scene)}};
  texts.push_back(
      table("samples.csv", samples_csv_header(trajectory), trajectory.time.size(),
            [&](std::size_t first, std::size_t last) { return samples_csv_rows(trajectory, first, last); }));
  if (!trajectory.contacts.empty()) {
    texts.push_back(
        table("contacts.csv", contacts_csv_header(trajectory), trajectory.contacts.size(),
              [&](std::size_t first, std::size_t last) { return contacts_csv_rows(trajectory, first, last); }));
  }
  return fill_page(page, page_name, trajectory.scene.title, texts);
}

}  // namespace tumble::output
