#include "tumble/lcp/problem_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "tumble/lcp/rational.hpp"
#include "tumble/math/format.hpp"
#include "tumble/math/numeric.hpp"

namespace tumble {
namespace {

struct Token {
  std::string_view text;
  std::size_t line;    // from 1
  std::size_t column;  // from 1, in bytes
};

// Splits the text into words, without blanks and comments, one inner list per line that has any.
std::vector<std::vector<Token>> split_lines(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\f\v";
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // as some editors put before the first line
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<std::vector<Token>> lines;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view content = text.substr(0, std::min(text.find('#'), end));
    text.remove_prefix(std::min(end + 1, text.size()));
    std::vector<Token> tokens;
    for (std::size_t at = content.find_first_not_of(blanks); at < content.size();) {
      const std::size_t stop = std::min(content.find_first_of(blanks, at), content.size());
      tokens.push_back({content.substr(at, stop - at), line, at + 1});
      at = content.find_first_not_of(blanks, stop);
    }
    if (!tokens.empty()) lines.push_back(std::move(tokens));
  }
  return lines;
}

[[noreturn]] void refuse(const std::string& name, const Token& token, const std::string& why) {
  throw std::invalid_argument(tumble::format("{}:{}:{}: {}", name, token.line, token.column, why));
}

// The word itself for a message: short, and without bytes that a terminal would act on.
std::string quoted(std::string_view word) {
  std::string shown;
  for (const char c : word.substr(0, 30)) shown += (c > 31 && c < 127) ? c : '?';
  return tumble::format("'{}{}'", shown, word.size() > 30 ? "..." : "");
}

double number(const std::string& name, const Token& token) {
  const std::optional<double> value = parse_fraction(token.text);
  if (!value) refuse(name, token, tumble::format("expected a number like 1e-3 or 1/3, got {}", quoted(token.text)));
  if (!std::isfinite(*value)) refuse(name, token, tumble::format("must be finite, got {}", quoted(token.text)));
  return *value;
}

std::string fraction(const std::string& name, const Token& token) {
  try {
    return to_text(parse_rational(token.text, k_max_file_digits));
  } catch (const std::invalid_argument& error) {
    refuse(name, token, tumble::format("{}, got {}", error.what(), quoted(token.text)));
  }
}

bool is_heading(const std::vector<Token>& line, std::string_view word) {
  return line.size() == 1 && line.front().text == word;
}

// M and q of a text; `number_of` reads one word.
template <class Problem, class NumberOf>
Problem parse(std::string_view text, const std::string& name, std::size_t max_size, NumberOf number_of) {
  const std::vector<std::vector<Token>> lines = split_lines(text);
  if (lines.empty()) throw std::invalid_argument(tumble::format("{}:1:1: empty, expected a line 'M'", name));
  if (!is_heading(lines.front(), "M")) {
    refuse(name, lines.front().front(),
           tumble::format("expected a line 'M' before the matrix, got {}", quoted(lines.front().front().text)));
  }
  Problem problem;
  const Token& last = lines.back().back();
  std::size_t n = 0;
  std::size_t at = 1;
  for (; at < lines.size() && !is_heading(lines[at], "q"); ++at) {
    const std::vector<Token>& row = lines[at];
    if (at == 1) n = row.size();
    if (n > max_size) {
      refuse(name, row[max_size], tumble::format("M: at most {} columns are read, got {}", max_size, n));
    }
    if (row.size() != n) {
      refuse(name, row.front(), tumble::format("M: row {} must have {} entries like row 1, got {}", at, n, row.size()));
    }
    if (at > n) refuse(name, row.front(), tumble::format("M: must be square, got more than {0} rows of {0}", n));
    for (const Token& token : row) problem.M.push_back(number_of(name, token));
  }
  if (at == lines.size()) refuse(name, last, "expected a line 'q' after the matrix");
  if (at - 1 != n || n == 0) {
    refuse(name, lines[at].front(),
           tumble::format("M: must be square with at least 1 row, got {} rows of {}", at - 1, n));
  }
  for (++at; at < lines.size(); ++at) {
    for (const Token& token : lines[at]) {
      if (problem.q.size() == n) refuse(name, token, tumble::format("q: must have {} entries, got more", n));
      problem.q.push_back(number_of(name, token));
    }
  }
  if (problem.q.size() != n) {
    refuse(name, last, tumble::format("q: must have {} entries, got {}", n, problem.q.size()));
  }
  return problem;
}

}  // namespace

LcpProblem parse_lcp(std::string_view text, const std::string& name) {
  return parse<LcpProblem>(text, name, k_max_text_problem_size, number);
}

ExactLcp parse_exact_lcp(std::string_view text, const std::string& name) {
  return parse<ExactLcp>(text, name, k_max_exact_size, fraction);
}

std::string to_text(const LcpProblem& problem) {
  std::string text = "M\n";
  for (std::size_t i = 0; i < problem.size(); ++i) {
    for (std::size_t j = 0; j < problem.size(); ++j) {
      if (j > 0) text += ' ';
      text += to_text(problem(i, j));
    }
    text += "\n";
  }
  text += "q\n";
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (i > 0) text += ' ';
    text += to_text(problem.q[i]);
  }
  return text + '\n';
}

}  // namespace tumble
