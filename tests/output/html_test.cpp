#include "tumble/output/html.hpp"

#include <stdexcept>

#include "../temporary_folder.hpp"
#include "record_samples.hpp"
#include <zlib.h>

#include "tumble/output/csv.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/file.hpp"
#include "tumble/output/trajectory_csv.hpp"
#include "tumble/output/write.hpp"
#include "tumble/scene/scene_toml.hpp"

namespace tumble::output {
namespace {

using test::has;

const std::string k_page = "<html><title>Viewer</title>\n<!--tumble-run-->\n<script>\"<title>\"</script></html>\n";

std::string decoded(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned group = 0, bits = 0;
  for (const char c : base64) {
    if (c == '=') break;
    EXPECT_NE(digits.find(c), std::string::npos);
    group = group << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255);
  }
  return bytes;
}

// The text of this name in a page; "" if it is not there.
std::string text_in(const std::string& html, const std::string& name) {
  const std::string before = "<script type=\"text/plain\" class=\"tumble-file\" data-name=\"" + name + "\">";
  const std::size_t start = html.find(before);
  if (start == std::string::npos) return "";
  const std::size_t from = start + before.size();
  const std::string base64 = html.substr(from, html.find("</script>", from) - from);
  EXPECT_EQ(base64.size() % 4, 0u);
  const std::string stream = decoded(base64);
  std::string text(1 << 22, '\0');
  uLongf size = text.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(stream.data()),
                       stream.size()),
            Z_OK);
  text.resize(size);
  return text;
}

TEST(Html, TextsOfAllLengthsComeBack) {
  for (const std::string text : {"", "a", "ab", "abc", "abcd", "</script>&\n\xc3\xbc"}) {
    EXPECT_EQ(text_in(fill_page(k_page, "page", "", {{"t", text}}), "t"), text);
  }
}

TEST(Html, ThePageStaysAsItIsButForRunAndTitle) {
  const std::string html = fill_page(k_page, "page", "", {});
  EXPECT_EQ(html, "<html><title>Viewer</title>\n\n<script>\"<title>\"</script></html>\n");
  const std::string titled = fill_page(k_page, "page", "<b> & \"'", {});
  EXPECT_EQ(titled, "<html><title>&lt;b&gt; &amp; &quot;&#39;</title>\n\n<script>\"<title>\"</script></html>\n");
}

TEST(Html, NamesAreEscaped) {
  EXPECT_TRUE(has(fill_page(k_page, "page", "", {{"a\"b", ""}}), "data-name=\"a&quot;b\">"));
}

TEST(Html, HoldsTheTablesOfTheRun) {
  const drop::Record record = test::course_record();
  const std::string html = to_html(record, k_page, "page");
  EXPECT_EQ(text_in(html, "record.csv"), to_csv(record));
  EXPECT_TRUE(has(html, "<title>Drop of a square of side 0.2 m</title>"));

  Trajectory run = trajectory_of(record);
  const std::string contacts = contacts_csv_header(run) + contacts_csv_rows(run, 0, run.contacts.size());
  EXPECT_EQ(text_in(to_html(run, k_page, "page"), "scene.toml"), to_toml(run.scene));
  EXPECT_EQ(text_in(to_html(run, k_page, "page"), "samples.csv"),
            samples_csv_header(run) + samples_csv_rows(run, 0, run.time.size()));
  EXPECT_EQ(text_in(to_html(run, k_page, "page"), "contacts.csv"), contacts);
  run.contacts.clear();
  EXPECT_FALSE(has(to_html(run, k_page, "page"), "contacts.csv"));
}

TEST(Html, RefusesOtherPages) {
  const auto refusal = [](const std::string& page) {
    return test::message_of<std::invalid_argument>([&] { check_page(page, "page.html"); });
  };
  EXPECT_EQ(refusal("<html></html>"),
            "page.html: is no page for runs: the comment <!--tumble-run--> must stand in it once, and is missing");
  EXPECT_TRUE(has(refusal(k_page + k_page), "stands there twice"));
}

TEST(Html, RefusesTextsThatNoBrowserHolds) {
  const std::vector<PageText> texts = {{"samples.csv", std::string(k_max_page_text + 1, ' ')}};
  EXPECT_TRUE(has(test::message_of<std::invalid_argument>([&] { fill_page(k_page, "page", "", texts); }),
                  "a page for a browser holds at most 256 MiB of samples.csv, this run has more"));
}

TEST(Html, IsWrittenIntoThePageNamed) {
  const tumble::test::TemporaryFolder folder;
  WriteOptions options;
  const auto refusal = [&] {
    return test::message_of<std::runtime_error>([&] { check_writable(folder / "run.html", options); });
  };
  EXPECT_EQ(refusal(), "page: an .html needs the page that shows it: none was named; `make viewer` builds it");
  options.page = folder / "page.html";
  EXPECT_TRUE(has(refusal(), "page.html: No such file or directory; `make viewer` builds it"));
  write_file_atomically(options.page, k_page, false);
  write_record(test::course_record(), folder / "run.html", options);
  EXPECT_EQ(read_file(folder / "run.html", 1'000'000), to_html(test::course_record(), k_page, "page"));
  EXPECT_THROW(write_record(test::course_record(), folder / "run.html", options), std::invalid_argument);
  write_file_atomically(options.page, "no page", true);
  EXPECT_THROW(check_writable(folder / "other.html", options), std::invalid_argument);
  EXPECT_EQ(folder.count_files(), 2u);
}

}  // namespace
}  // namespace tumble::output
