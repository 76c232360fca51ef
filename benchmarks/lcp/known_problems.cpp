#include "known_problems.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tumble/lcp/problem_text.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble::problems {
namespace {

constexpr std::string_view k_blanks = " \t\r";

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> all;
  for (std::size_t at = text.find_first_not_of(k_blanks); at < text.size();) {
    const std::size_t stop = std::min(text.find_first_of(k_blanks, at), text.size());
    all.emplace_back(text.substr(at, stop - at));
    at = text.find_first_not_of(k_blanks, stop);
  }
  return all;
}

std::vector<double> numbers(std::string_view text, const std::string& place) {
  std::vector<double> values;
  for (const std::string& word : words(text)) {
    const std::optional<double> value = parse_fraction(word);
    if (!value) throw std::invalid_argument(tumble::format("{}: expected numbers like 1e-3 or 1/3", place));
    values.push_back(*value);
  }
  return values;
}

// What a line says after "# key:", or nothing if it is another line.
std::optional<std::string_view> value_of(std::string_view line, std::string_view key) {
  const std::string start = tumble::format("# {}:", key);
  if (!line.starts_with(start)) return std::nullopt;
  return line.substr(start.size());
}

}  // namespace

KnownProblem parse_known_problem(std::string_view text, const std::string& name) {
  KnownProblem known{name, parse_lcp(text, name), {}, {}, {}, std::string(text), {}};
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::string place = tumble::format("{}:{}", name, number);
    const auto vector = [&](std::string_view value) {
      std::vector<double> values = numbers(value, place);
      if (values.size() == known.problem.size()) return values;
      throw std::invalid_argument(
          tumble::format("{}: must have {} entries, got {}", place, known.problem.size(), values.size()));
    };
    if (const auto value = value_of(line, "solutions")) {
      const std::vector<double> count = numbers(*value, place);
      if (count.size() != 1 || !(count[0] >= 0.0 && count[0] <= 1e6)) {
        throw std::invalid_argument(tumble::format("{}: expected one whole number from 0 to 1000000", place));
      }
      known.num_solutions = static_cast<std::size_t>(count[0]);
    }
    if (const auto value = value_of(line, "solution")) {
      known.solutions.push_back(vector(*value));
      known.exact_solutions.push_back(words(*value));
    }
    if (const auto value = value_of(line, "infeasible")) known.certificate = vector(*value);
  }
  return known;
}

std::vector<KnownProblem> read_known_problems(const std::filesystem::path& file_or_folder) {
  std::vector<std::filesystem::path> files;
  if (std::filesystem::is_directory(file_or_folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(file_or_folder)) {
      if (entry.path().extension() == ".txt") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  } else {
    files.push_back(file_or_folder);
  }
  std::vector<KnownProblem> known;
  for (const std::filesystem::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw std::runtime_error(tumble::format("{}: cannot be read", file.string()));
    known.push_back(parse_known_problem(text, file.string()));
    known.back().name = file.stem().string();
  }
  return known;
}

}  // namespace tumble::problems
