#include "tumble/output/gif.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gif_lib.h>

#include "tumble/math/format.hpp"
#include "tumble/output/animation.hpp"
#include "tumble/output/draw.hpp"
#include "tumble/output/draw_bodies.hpp"

namespace tumble::output {
namespace {

// Fewer colours pack better: 64 hold all ramps of pictures with bodies of one kind. The last one stands for "as in the
// picture before".
constexpr std::size_t k_few_colours = 64;
constexpr std::size_t k_most_colours = 256;
constexpr int k_delay = 2;  // [1/100 s], k_frame_time

// ---- Colours ----

std::uint32_t packed(const Colour& colour) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255.0 * value)); };
  return byte(colour.red) << 16 | byte(colour.green) << 8 | byte(colour.blue);
}

using Palette = std::vector<std::uint32_t>;  // a power of two of colours

std::uint8_t transparent(const Palette& palette) { return static_cast<std::uint8_t>(palette.size() - 1); }

// The colours of the bodies that move, each once.
std::vector<BodyColours> kinds_of(const Scene& scene) {
  std::vector<BodyColours> kinds;
  const std::vector<BodyColours> colours = body_colours(scene);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const bool is_known = std::any_of(kinds.begin(), kinds.end(), [&](const BodyColours& other) {
      return packed(other.fill) == packed(colours[i].fill);
    });
    if (!is_known && scene.bodies[i].kind != BodyKind::fixed) kinds.push_back(colours[i]);
  }
  return kinds;
}

// The colours of the pictures and their way to the paper, or to what else they meet, where edges are
// smoothed.
Palette make_palette(const Scene& scene) {
  Palette palette = {packed(k_paper)};
  const auto add_ramp = [&](const Colour& from, const Colour& to, int steps) {
    for (int i = 1; i <= steps; ++i) palette.push_back(packed(mix(from, to, static_cast<double>(i) / steps)));
  };
  add_ramp(k_paper, k_ink, 8);
  add_ramp(k_paper, k_muted, 6);
  add_ramp(k_paper, k_ground, 3);
  palette.push_back(packed(k_grid));
  palette.push_back(packed(mix(k_paper, k_grid, 0.5)));
  palette.push_back(packed(mix(k_paper, k_muted, 0.1)));
  palette.push_back(packed(k_accent));
  palette.push_back(packed(k_fixed_fill));
  const std::vector<BodyColours> kinds = kinds_of(scene);
  for (const BodyColours& kind : kinds) {
    add_ramp(k_paper, kind.deep, 8);
    palette.push_back(packed(kind.fill));
    palette.push_back(packed(mix(kind.fill, k_paper, 0.5)));
    add_ramp(kind.fill, kind.deep, 4);
  }
  for (const Colour& colour : {k_stick, k_slip_left, k_slip_right}) {
    add_ramp(k_paper, colour, 7);
    for (const BodyColours& kind : kinds) palette.push_back(packed(mix(kind.fill, colour, 0.5)));
  }
  std::size_t size = k_few_colours;
  while (size <= palette.size()) size *= 2;
  palette.resize(std::min(size, k_most_colours), packed(k_paper));
  return palette;
}

// The nearest colour of the palette, looked up by the upper 5 bits of red, green and blue.
class Quantiser {
 public:
  explicit Quantiser(const Palette& palette) : nearest_(1 << 15) {
    for (std::uint32_t key = 0; key < nearest_.size(); ++key) {
      int best = 1 << 30;
      for (std::size_t i = 0; i + 1 < palette.size(); ++i) {
        int distance = 0;
        for (const int shift : {0, 5, 10}) {
          // 5 bits to 8: the upper bits again below, so that 31 becomes 255.
          const int wanted = static_cast<int>(key >> shift & 31u) * 255 / 31;
          const int offered = static_cast<int>(palette[i] >> (shift / 5 * 8) & 255u);
          distance += (wanted - offered) * (wanted - offered);
        }
        if (distance < best) {
          best = distance;
          nearest_[key] = static_cast<std::uint8_t>(i);
        }
      }
    }
  }

  void apply(const std::vector<std::uint32_t>& pixels, std::vector<std::uint8_t>& indices) const {
    indices.resize(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const std::uint32_t p = pixels[i];
      indices[i] = nearest_[(p >> 9 & 0x7c00u) | (p >> 6 & 0x3e0u) | (p >> 3 & 0x1fu)];
    }
  }

 private:
  std::vector<std::uint8_t> nearest_;
};

// ---- Pictures that change ----

struct Patch {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> indices;
};

// The rectangle in which `now` differs, unchanged pixels transparent; nothing if they are equal.
std::optional<Patch> changed_part(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& now,
                                  int width, std::uint8_t transparent) {
  const int height = static_cast<int>(now.size()) / width;
  int left = width;
  int right = -1;
  int top = height;
  int bottom = -1;
  for (int y = 0; y < height; ++y) {
    const auto row = static_cast<std::ptrdiff_t>(y) * width;
    const auto begin = now.begin() + row;
    const auto first = std::mismatch(begin, begin + width, before.begin() + row).first;
    if (first == begin + width) continue;
    int x = width - 1;
    while (now[static_cast<std::size_t>(row + x)] == before[static_cast<std::size_t>(row + x)]) --x;
    left = std::min(left, static_cast<int>(first - begin));
    right = std::max(right, x);
    top = std::min(top, y);
    bottom = y;
  }
  if (bottom < 0) return std::nullopt;
  Patch patch{left, top, right - left + 1, bottom - top + 1, {}};
  patch.indices.reserve(static_cast<std::size_t>(patch.width) * static_cast<std::size_t>(patch.height));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      patch.indices.push_back(now[at] == before[at] ? transparent : now[at]);
    }
  }
  return patch;
}

// ---- The file ----

int append(GifFileType* file, const GifByteType* data, int length) {
  try {
    static_cast<std::string*>(file->UserData)
        ->append(reinterpret_cast<const char*>(data), static_cast<std::size_t>(length));
  } catch (...) {
    return 0;  // no exception may pass through the C code
  }
  return length;
}

class GifWriter {
 public:
  GifWriter(int width, int height, const Palette& palette) : transparent_(transparent(palette)) {
    int error = 0;
    file_ = EGifOpen(bytes_.get(), append, &error);
    if (file_ == nullptr) fail(error);
    EGifSetGifVersion(file_, true);
    std::vector<GifColorType> colours;
    for (const std::uint32_t colour : palette) {
      colours.push_back({static_cast<GifByteType>(colour >> 16), static_cast<GifByteType>(colour >> 8 & 255u),
                         static_cast<GifByteType>(colour & 255u)});
    }
    const auto count = static_cast<int>(colours.size());
    const std::unique_ptr<ColorMapObject, void (*)(ColorMapObject*)> map(GifMakeMapObject(count, colours.data()),
                                                                         GifFreeMapObject);
    if (!map) throw std::bad_alloc();
    require(EGifPutScreenDesc(file_, width, height, map->BitsPerPixel, 0, map.get()));
    // Repeats for ever: the block that Netscape introduced and all viewers know.
    constexpr std::array<GifByteType, 3> k_for_ever = {1, 0, 0};
    require(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    require(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    require(EGifPutExtensionBlock(file_, k_for_ever.size(), k_for_ever.data()));
    require(EGifPutExtensionTrailer(file_));
  }

  ~GifWriter() {
    int error = 0;
    if (file_ != nullptr) EGifCloseFile(file_, &error);
  }
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;

  // `delay` in 1/100 s.
  void add(Patch& patch, int delay) {
    const GraphicsControlBlock control{DISPOSE_DO_NOT, false, delay, transparent_};
    std::array<GifByteType, 4> extension{};
    const std::size_t size = EGifGCBToExtension(&control, extension.data());
    require(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(size), extension.data()));
    require(EGifPutImageDesc(file_, patch.left, patch.top, patch.width, patch.height, false, nullptr));
    for (int y = 0; y < patch.height; ++y) {
      require(EGifPutLine(file_, patch.indices.data() + static_cast<std::ptrdiff_t>(y) * patch.width, patch.width));
    }
  }

  std::string finish() {
    int error = 0;
    const int result = EGifCloseFile(file_, &error);  // frees the file also where it fails
    file_ = nullptr;
    if (result != GIF_OK) fail(error);
    return std::move(*bytes_);
  }

 private:
  [[noreturn]] static void fail(int error) {
    const char* reason = GifErrorString(error);
    throw std::runtime_error(tumble::format("giflib cannot write: {}", reason != nullptr ? reason : "unknown reason"));
  }

  void require(int result) const {
    if (result != GIF_OK) fail(file_->Error);
  }

  std::unique_ptr<std::string> bytes_ = std::make_unique<std::string>();  // at a fixed address for giflib
  GifFileType* file_ = nullptr;
  std::uint8_t transparent_;
};

}  // namespace

std::string to_gif(const Trajectory& trajectory, int width, int height, double speed) {
  Animation animation(trajectory, width, height, speed, k_max_gif_frames);
  const Palette palette = make_palette(trajectory.scene);
  const Quantiser quantiser(palette);
  GifWriter writer(width, height, palette);

  // A picture is written when the next different one is there: only then is known how long it stays.
  Patch waiting{0, 0, width, height, {}};
  quantiser.apply(animation.draw(0), waiting.indices);
  std::vector<std::uint8_t> before = waiting.indices;
  std::vector<std::uint8_t> now;
  int delay = k_delay;
  for (int i = 1; i < animation.frames(); ++i) {
    quantiser.apply(animation.draw(i), now);
    std::optional<Patch> patch = changed_part(before, now, width, transparent(palette));
    if (!patch) {
      delay += k_delay;
      continue;
    }
    writer.add(waiting, delay);
    waiting = std::move(*patch);
    before.swap(now);
    delay = k_delay;
  }
  writer.add(waiting, delay + static_cast<int>(std::lround(100.0 * k_hold_time)) - k_delay);
  return writer.finish();
}

}  // namespace tumble::output
