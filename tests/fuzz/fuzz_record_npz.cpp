// libFuzzer: any bytes are a record or are refused with std::invalid_argument; a record reads back from its
// own bytes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/output/npz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  tumble::drop::Record record;
  try {
    record = tumble::output::parse_record_npz(bytes, "fuzz.npz");
  } catch (const std::invalid_argument&) {
    return 0;
  }
  const std::string written = tumble::output::to_npz(record);
  if (tumble::output::to_npz(tumble::output::parse_record_npz(written, "again.npz")) != written) std::abort();
  return 0;
}
