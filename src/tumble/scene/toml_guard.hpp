// What must hold of a text before toml++ 3.3 may read it. Not a public header.
#pragma once

#include <string>
#include <string_view>

namespace tumble {

// Throws std::invalid_argument "<name>:<line>:<column>: ..." for texts on which toml++ 3.3 has undefined behaviour or
// uses up the memory or the stack: invalid UTF-8; characters beyond ASCII where it asks whether they are blanks, which
// is outside of strings and comments and behind a backslash; strings and brackets where none may stand, which it takes
// for bare text; table headers without a name; very many values; keys of very many parts. Of all this TOML allows only
// the sizes and a character beyond ASCII behind a line end with a backslash.
void guard_toml(std::string_view text, const std::string& name);

}  // namespace tumble
