// libFuzzer: any text is a record or is refused with std::invalid_argument; a record reads back from its own
// text.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tumble/output/csv.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  tumble::drop::Record record;
  try {
    record = tumble::output::parse_record_csv(text, "fuzz.csv");
  } catch (const std::invalid_argument&) {
    return 0;
  }
  const std::string written = tumble::output::to_csv(record);
  if (tumble::output::to_csv(tumble::output::parse_record_csv(written, "again.csv")) != written) std::abort();
  return 0;
}
