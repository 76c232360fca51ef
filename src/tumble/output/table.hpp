// Tables with more rows than fit into memory: columns that are written piece by piece.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tumble/output/field.hpp"

namespace tumble::output {

struct TableColumn {
  std::string name;
  std::string unit;       // "" if it has none
  bool is_whole = false;  // whole numbers of 32 bits, else doubles
};

struct Table {
  std::vector<TableColumn> columns;
  std::size_t rows = 0;
  // Hands the values of a column to `take` in order, in pieces of any length: little-endian, 4 or 8 bytes each.
  std::function<void(std::size_t column, const std::function<void(std::string_view bytes)>& take)> read;
  std::vector<Field> notes;  // small arrays that stand beside the columns
};

// By the ending of the name, .npz (not compressed, so that it is written as fast as the disk) or .h5; all or nothing.
// The bytes depend on columns and notes alone. Throws std::invalid_argument for other endings and as OutputFile,
// std::runtime_error if it cannot be written.
void write_table(const Table& table, const std::filesystem::path& path, bool overwrite);

// Everything about it that can be said beforehand. Throws std::invalid_argument, and std::runtime_error if this build
// has no HDF5.
void check_table_writable(const std::filesystem::path& path, bool overwrite);

// True for names that end in .npz or .h5, in any case.
bool is_table_name(const std::filesystem::path& path);

}  // namespace tumble::output
