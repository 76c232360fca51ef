#include "tumble/scene/toml_guard.hpp"

#include <stdexcept>

#include "tumble/math/format.hpp"
#include "tumble/scene/check.hpp"

namespace tumble {
namespace {

constexpr int k_max_key_parts = 16;
constexpr std::string_view k_byte_order_mark = "\xEF\xBB\xBF";  // as some editors put in front

// Goes through the text character by character and knows what is a string, a comment, a key or a value. It refuses a
// string or bracket where TOML has none, since toml++ would take it for a part of the bare text before it.
class Guard {
 public:
  Guard(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    if (text_.starts_with(k_byte_order_mark)) at_ = k_byte_order_mark.size();
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        skip_comment();
      } else if (c == '"' || c == '\'') {
        if (has_text_ && !(last_ == '.' && !is_value_)) refuse("a string must not stand behind other text");
        skip_string(c);
        has_text_ = true;
        last_ = c;
      } else {
        check_bare(c);
        advance();
      }
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::invalid_argument(tumble::format("{}:{}:{}: {}", name_, line_, column_, why));
  }

  bool is_next(std::string_view word) const { return text_.substr(at_).starts_with(word); }

  // One character on; the text must be UTF-8 there.
  void advance() {
    const auto first = static_cast<unsigned char>(text_[at_]);
    const std::size_t size = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (size > 1 && !is_plain_text(text_.substr(at_, size))) {
      refuse("must be UTF-8 without control characters, got other bytes");
    }
    at_ += size;
    ++column_;
    if (first == '\n') {
      ++line_;
      column_ = 1;
    }
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') advance();
  }

  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool is_long = is_next(triple);
    const std::string end = is_long ? triple : std::string(1, quote);
    for (std::size_t i = 0; i < end.size(); ++i) advance();
    while (!is_next(end)) {
      if (at_ >= text_.size() || (!is_long && text_[at_] == '\n')) refuse("the string must end with its quote");
      if (quote == '"' && text_[at_] == '\\') {
        skip_escape();
      } else {
        advance();
      }
    }
    for (std::size_t i = 0; i < end.size(); ++i) advance();
    // Up to two quotes may stand before the closing ones.
    for (int i = 0; is_long && i < 2 && is_next(end.substr(0, 1)); ++i) advance();
  }

  // A backslash and what it goes with: one character, or the line end and all blanks behind it. Behind it toml++ asks
  // whether there is another blank, which is undefined for most characters beyond ASCII.
  void skip_escape() {
    const std::size_t next = text_.find_first_not_of(" \t\r\n", at_ + 1);
    if (next < text_.size() && static_cast<unsigned char>(text_[next]) >= 0x80) {
      refuse("a character beyond ASCII must not follow a backslash");
    }
    advance();
    if (at_ < text_.size()) advance();
  }

  // A character outside of strings and comments.
  void check_bare(char c) {
    if (static_cast<unsigned char>(c) >= 0x80) refuse("a character beyond ASCII must stand in quotes or in a comment");
    if (c == ' ' || c == '\t' || c == '\r') return;
    switch (c) {
      case '\n':
        if (brackets_.empty()) start(false);
        break;
      case '=':
        if (is_value_) refuse("'=' must not stand in a value");
        start(true);
        break;
      case ',': start(!brackets_.empty() && brackets_.back() == '['); break;
      case '[':
      case '{': open(c); break;
      case ']':
      case '}':
        if (!brackets_.empty()) brackets_.pop_back();
        is_value_ = is_value_ || c == '}';
        has_text_ = true;
        break;
      default:
        if (c == '.' && ++key_parts_ > k_max_key_parts)
          refuse(tumble::format("a key has at most {} parts", k_max_key_parts));
        has_text_ = true;
    }
    last_ = c;
  }

  // A new key or value begins behind this character.
  void start(bool is_value) {
    is_value_ = is_value;
    has_text_ = false;
    key_parts_ = 0;
    if (++values_ > k_max_scene_values) refuse(tumble::format("at most {} values are read", k_max_scene_values));
  }

  void open(char bracket) {
    if (is_value_) {
      if (has_text_) refuse(tumble::format("'{}' must not stand behind other text", bracket));
      start(bracket == '[');
      brackets_ += bracket;
    } else if (bracket == '[' && brackets_ == "h" && last_ == '[') {
      brackets_ += 'h';  // the second one of [[name]]
    } else if (bracket == '[' && brackets_.empty() && !has_text_) {
      check_header();
      start(false);
      brackets_ += 'h';
    } else {
      refuse(tumble::format("'{}' must not stand in a key", bracket));
    }
  }

  void check_header() const {
    std::size_t at = text_.find_first_not_of(" \t", at_ + 1);
    if (at < text_.size() && text_[at] == '[') at = text_.find_first_not_of(" \t", at + 1);
    const char c = at < text_.size() ? text_[at] : '\n';
    const bool is_name = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                         c == '-' || c == '"' || c == '\'';
    if (!is_name) refuse("a table header must be like [name] or [[name]]");
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1, column_ = 1;
  std::size_t values_ = 0;
  int key_parts_ = 0;
  std::string brackets_;   // open ones; 'h' for those of a table header
  bool is_value_ = false;  // or a key
  bool has_text_ = false;  // of this key or value
  char last_ = '\n';       // character outside of strings, comments and blanks
};

}  // namespace

void guard_toml(std::string_view text, const std::string& name) {
  if (text.size() > k_max_scene_bytes) {
    throw std::invalid_argument(
        tumble::format("{}:1:1: at most {} bytes are read, got {}", name, k_max_scene_bytes, text.size()));
  }
  Guard(text, name).check();
}

}  // namespace tumble
