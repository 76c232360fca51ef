#include <cmath>
#include <set>
#include <stdexcept>

#include "record_samples.hpp"
#include <gif_lib.h>

#include "tumble/output/animation.hpp"
#include "tumble/output/drop_trajectory.hpp"
#include "tumble/output/gif.hpp"
#include "tumble/output/impulses.hpp"
#include "tumble/output/strobe.hpp"
#include "tumble/output/view.hpp"

// fontconfig, behind cairo's text, keeps its tables until the end of the process; LeakSanitizer asks here.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }

namespace tumble::output {
namespace {

using test::has;

Trajectory run(const Vector3& q, const Vector3& v, const drop::Parameters& parameters) {
  return trajectory_of(drop::simulate_with_record(q, v, parameters));
}

Trajectory course_run(int columns = 150) { return trajectory_of(test::course_record(columns)); }

// Starts that leave a naive picture without a size, without a scale, or with coordinates that no number tells
// apart.
std::vector<Trajectory> odd_runs() {
  std::vector<Trajectory> runs = {course_run(2), course_run(3)};
  drop::Parameters p;
  p.columns = 20;
  p.g = 0.0;
  runs.push_back(run({0.0, 1.0, 0.3}, {0.0, 0.0, 0.0}, p));  // no motion
  p = {.columns = 20};
  runs.push_back(run({1e9, 1e6, 0.3}, {1.0, 0.0, 0.0}, p));    // far from the ground and from the origin
  runs.push_back(run({0.0, 1e9, 0.3}, {1e9, 1e9, 2.0}, p));    // a speck on a long way
  runs.push_back(run({1e15, 1e15, 0.3}, {0.0, 0.0, 0.0}, p));  // steps below the spacing of double
  runs.push_back(run({0.0, -50.0, 0.3}, {1.0, 0.0, 0.0}, p));  // below the ground
  runs.push_back(run({-1e99, 1e99, 0.3}, {1e99, 0.0, 0.0}, p));
  runs.push_back(run({0.0, 0.2, 1e12}, {0.0, 0.0, 1e12}, p));
  p = {.l = 1e-9, .dt = 1e-6, .delta = 1e-12, .columns = 150};
  runs.push_back(run({0.0, 1e-9, 0.3}, {1e-5, 0.0, 1e3}, p));
  p = {.l = 1e9, .dt = 100.0, .delta = 0.0, .columns = 20};
  runs.push_back(run({0.0, 1.5e9, 0.5}, {0.0, 0.0, 0.0}, p));
  p = {.mu = 1e300, .columns = 50};
  runs.push_back(run({0.0, 0.2, 0.5}, {2.0, 0.0, 0.0}, p));
  p = {.m = 1e200, .g = 1e100, .columns = 5};
  runs.push_back(run({0.0, 1.0, 0.5}, {0.0, 0.0, 0.0}, p));  // energies beyond the range of double
  return runs;
}

TEST(View, FitsTheWholePathAndKeepsTheAspect) {
  const Area area{70.0, 100.0, 400.0, 300.0};
  for (const Trajectory& trajectory : odd_runs()) {
    const View view = fit_view(sight_of(trajectory), area, {10.0, 10.0, 20.0});
    ASSERT_TRUE(std::isfinite(view.scale) && view.scale > 0.0);
    for (std::size_t k = 0; k < trajectory.time.size(); ++k) {
      const Point point = view.to_pixel(trajectory.bodies(k)[1].pose.position);
      EXPECT_GE(point.x, area.left);
      EXPECT_LE(point.x, area.right());
      EXPECT_GE(point.y, area.top);
      EXPECT_LE(point.y, area.bottom());
    }
  }
}

TEST(View, RefusesWhatNoPictureCanHold) {
  drop::Parameters p;
  p.columns = 3;
  for (const Vector3& q : {Vector3{0.0, 1e200, 0.0}, Vector3{-1e101, 1.0, 0.0}}) {
    const std::string text = test::message_of<std::invalid_argument>([&] { sight_of(run(q, {}, p)); });
    EXPECT_TRUE(has(text, "picture: positions must lie in [-1e+100, 1e+100] m")) << text;
  }
}

TEST(View, TicksAreFewAndDifferent) {
  for (const Trajectory& trajectory : odd_runs()) {
    const View view = fit_view(sight_of(trajectory), {70.0, 100.0, 400.0, 300.0}, {10.0, 10.0, 20.0});
    for (const Axis& axis : {axis_x(view, 6), axis_y(view, 6)}) {
      EXPECT_LE(axis.ticks.size(), 8u);
      EXPECT_GE(axis.ticks.size(), 2u);
      std::set<std::string> labels;
      for (const Tick& tick : axis.ticks) {
        labels.insert(tick.label);
        EXPECT_LE(tick.label.size(), 11u);
        EXPECT_TRUE(std::isfinite(tick.pixel));
      }
      EXPECT_EQ(labels.size(), axis.ticks.size());
    }
  }
}

TEST(View, NiceNumbersAreOneTwoFive) {
  EXPECT_DOUBLE_EQ(round_down_nicely(0.499), 0.2);
  EXPECT_DOUBLE_EQ(round_down_nicely(0.5), 0.5);
  EXPECT_DOUBLE_EQ(round_down_nicely(9.9e-7), 5e-7);
  EXPECT_DOUBLE_EQ(round_up_nicely(1.49 / 30.0), 0.05);
  EXPECT_DOUBLE_EQ(round_up_nicely(0.5), 0.5);
  EXPECT_DOUBLE_EQ(round_up_nicely(501.0), 1000.0);
}

TEST(Impulses, AreForceTimesStep) {
  const drop::Record record = test::course_record();
  const std::vector<Impulse> impulses = largest_of_each_touch(trajectory_of(record));
  ASSERT_EQ(impulses.size(), 6u) << "contacts of the document's first start";
  EXPECT_EQ(impulses[0].step, 52) << "from column 51";
  const Vector4 z = record.steps[51].z;
  EXPECT_DOUBLE_EQ(impulses[0].along_normal, 0.01 * z[0]);
  EXPECT_DOUBLE_EQ(impulses[0].along_tangent, 0.01 * (z[2] - z[1]));
  EXPECT_DOUBLE_EQ(largest_size(impulses), impulses[0].size);
  const std::vector<Impulse> two = keep_largest(impulses, 2, 0.0);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_LT(two[0].step, two[1].step);
  EXPECT_EQ(keep_largest(impulses, 10, 0.5 * impulses[0].size).size(), 1u);
}

TEST(Strobe, DrawsOddRuns) {
  for (const Trajectory& trajectory : odd_runs()) {
    EXPECT_TRUE(to_strobe_png(trajectory).starts_with("\x89PNG"));
    const std::string svg = to_strobe_svg(trajectory);
    EXPECT_TRUE(has(svg, "<svg") && has(svg, "</svg>"));
    EXPECT_FALSE(has(svg, "nan") || has(svg, "inf"));
  }
}

TEST(Strobe, HasTheSizeAskedFor) {
  const Trajectory trajectory = course_run();
  const auto size_of = [](const std::string& png) {
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(png.at(at + i));
      return value;
    };
    return std::pair{number(16), number(20)};
  };
  EXPECT_EQ(size_of(to_strobe_png(trajectory, 800, 600)), std::pair(800, 600));
  EXPECT_EQ(size_of(to_strobe_png(trajectory, 160, 160)), std::pair(160, 160));
  EXPECT_EQ(size_of(to_strobe_png(trajectory, 1000, 0)).first, 1000);
  EXPECT_EQ(size_of(to_strobe_png(trajectory, 0, 700)).second, 700);
}

TEST(Strobe, TheSameRunGivesTheSameBytes) {
  const Trajectory trajectory = course_run();
  EXPECT_TRUE(to_strobe_png(trajectory) == to_strobe_png(trajectory));
  EXPECT_TRUE(to_strobe_svg(trajectory) == to_strobe_svg(trajectory));
  EXPECT_TRUE(to_gif(trajectory, 320, 200) == to_gif(trajectory, 320, 200));
}

TEST(Strobe, OfALongRunStaysSmall) {
  drop::Parameters parameters;
  parameters.columns = 200'000;
  const Trajectory trajectory = run({0.0, 0.5, 0.3}, {2.0, 0.0, -3.0}, parameters);
  EXPECT_LT(to_strobe_svg(trajectory).size(), 1'000'000u);
}

TEST(Animation, ShowsRealTime) {
  EXPECT_EQ(count_frames(0.0, 1.0, 10), 1);
  EXPECT_EQ(count_frames(1.49, 1.0, 1000), 76);  // 1.49 s, the last picture is the last column
  EXPECT_EQ(count_frames(1.5, 1.0, 1000), 76);   // 1.5 s
  EXPECT_EQ(count_frames(1.5, 0.5, 1000), 151);
  EXPECT_EQ(count_frames(1e-9, 1.0, 1000), 2);
  EXPECT_THROW(count_frames(1.49, 0.0, 1000), std::invalid_argument);
  EXPECT_THROW(count_frames(1.49, std::nan(""), 1000), std::invalid_argument);
  const std::string text = test::message_of<std::invalid_argument>([] { count_frames(1e307, 1.0, 3000); });
  EXPECT_TRUE(has(text, "animation: at most 60 s of film")) << text;
}

// giflib's own view of the bytes.
struct Gif {
  explicit Gif(std::string the_bytes) : bytes(std::move(the_bytes)) {
    int error = 0;
    file = DGifOpen(
        this,
        [](GifFileType* f, GifByteType* data, int size) {
          auto* self = static_cast<Gif*>(f->UserData);
          const std::size_t got =
              self->bytes.copy(reinterpret_cast<char*>(data), static_cast<std::size_t>(size), self->at);
          self->at += got;
          return static_cast<int>(got);
        },
        &error);
    good = file != nullptr && DGifSlurp(file) == GIF_OK;
  }
  ~Gif() {
    int error = 0;
    if (file != nullptr) DGifCloseFile(file, &error);
  }
  Gif(const Gif&) = delete;
  Gif& operator=(const Gif&) = delete;

  int delay(int i) const {
    GraphicsControlBlock block{};
    EXPECT_EQ(DGifSavedExtensionToGCB(file, i, &block), GIF_OK);
    return block.DelayTime;
  }

  std::string bytes;
  std::size_t at = 0;
  GifFileType* file = nullptr;
  bool good = false;
};

TEST(GifFile, LastsAsLongAsTheRunAndTheHold) {
  const Trajectory trajectory = course_run();
  const Gif gif(to_gif(trajectory, 640, 400));
  ASSERT_TRUE(gif.good);
  EXPECT_LT(gif.bytes.size(), 400'000u);
  EXPECT_EQ(gif.file->SWidth, 640);
  EXPECT_EQ(gif.file->SHeight, 400);
  EXPECT_TRUE(has(gif.bytes, "NETSCAPE2.0"));
  int hundredths = 0;
  for (int i = 0; i < gif.file->ImageCount; ++i) {
    EXPECT_GE(gif.delay(i), 2) << "browsers slow shorter ones down";
    hundredths += gif.delay(i);
  }
  EXPECT_EQ(hundredths, 2 * 75 + 80);
  EXPECT_EQ(gif.delay(gif.file->ImageCount - 1), 80);
}

TEST(GifFile, PatchesAddUpToTheWholePictures) {
  const Trajectory trajectory = course_run(60);
  const Gif gif(to_gif(trajectory, 320, 200));
  ASSERT_TRUE(gif.good);
  Animation animation(trajectory, 320, 200, 1.0, k_max_gif_frames);
  ASSERT_EQ(gif.file->ImageCount, animation.frames());
  std::vector<int> shown(320 * 200, -1);
  for (int i = 0; i < animation.frames(); ++i) {
    const SavedImage& image = gif.file->SavedImages[i];
    const GifImageDesc& part = image.ImageDesc;
    for (int y = 0; y < part.Height; ++y) {
      for (int x = 0; x < part.Width; ++x) {
        const int index = image.RasterBits[y * part.Width + x];
        if (index != 63) shown[static_cast<std::size_t>((part.Top + y) * 320 + part.Left + x)] = index;
      }
    }
    const std::vector<std::uint32_t> pixels = animation.draw(i);
    int worst = 0;
    for (std::size_t at = 0; at < pixels.size(); ++at) {
      ASSERT_GE(shown[at], 0);
      const GifColorType colour = gif.file->SColorMap->Colors[shown[at]];
      const auto off = [&](int shift, int value) {
        return std::abs(static_cast<int>(pixels[at] >> shift & 255u) - value);
      };
      worst = std::max({worst, off(16, colour.Red), off(8, colour.Green), off(0, colour.Blue)});
    }
    // The palette holds every colour of the pictures and enough of their mixtures.
    EXPECT_LE(worst, 90) << "picture " << i;
  }
}

TEST(GifFile, DrawsOddRuns) {
  for (const Trajectory& trajectory : odd_runs()) {
    if (trajectory.time.back() > 60.0) {
      EXPECT_THROW(to_gif(trajectory, 160, 160), std::invalid_argument);
      continue;
    }
    EXPECT_TRUE(Gif(to_gif(trajectory, 160, 160)).good);
  }
}

TEST(GifFile, RepeatsPicturesOfARunAtRestByTheirDelay) {
  drop::Parameters parameters;
  parameters.columns = 2;
  parameters.dt = 10.0;
  parameters.g = 0.0;
  const Gif gif(to_gif(run({0.0, 1.0, 0.0}, {}, parameters), 320, 200));
  ASSERT_TRUE(gif.good);
  EXPECT_EQ(gif.file->ImageCount, 2) << "the time changes once, half-way";
  EXPECT_EQ(gif.delay(0) + gif.delay(1), 1000 + 80);
}

}  // namespace
}  // namespace tumble::output
