// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/calibrate/sphere_calibration.h"
#include "session/app_model.h"
#include "session/listening.h"
#include "session/live/live_picture.h"
#include "view/charts/sphere_chart.h"

namespace sonar {

/// Spheres that are sold for calibration, by material and diameter; `own` is what the fields beside it say.
enum class SpherePreset : std::uint8_t { own, wc38_1, wc25, wc22, wc20, cu60, cu32_1, cu23, cu13_7 };
inline constexpr std::array<std::string_view, 9> kSpherePresetNames{"own",  "WC38.1", "WC25", "WC22",  "WC20",
                                                                    "Cu60", "Cu32.1", "Cu23", "Cu13.7"};
/// In the order of material_text().
enum class SphereSolid : std::uint8_t { tungsten_carbide, copper };
inline constexpr std::array<std::string_view, 2> kSphereSolidNames{"tungsten_carbide", "copper"};

/// What a human says of a sphere run.
struct SphereAsked {
  SpherePreset sphere = SpherePreset::wc38_1;
  SphereSolid material = SphereSolid::tungsten_carbide;
  double diameter_mm = 38.1;
  double range_from_m = 10.0;
  double range_to_m = 1000.0;
  bool measured_water = false;
  double temperature_c = 8.0;
  double salinity_psu = 35.0;
  double depth_m = 10.0;
  friend bool operator==(const SphereAsked&, const SphereAsked&) = default;
};

template <class Visitor>
void describe(Visitor& v, SphereAsked& p) {
  v.choice("sphere", p.sphere, kSpherePresetNames, "Sphere that was used: material and diameter in mm.");
  v.choice("material", p.material, kSphereSolidNames, "What the sphere is made of.");
  v.field("diameter_mm", p.diameter_mm, {.unit = "mm", .min = 5, .max = 200, .text = "Diameter of the sphere."});
  v.field("range_from_m", p.range_from_m,
          {.unit = "m", .min = 0, .max = 1000, .text = "The sphere is looked for from this range on."});
  v.field("range_to_m", p.range_to_m, {.unit = "m", .min = 1, .max = 10000, .text = "As far as this range."});
  v.field("measured_water", p.measured_water,
          {.text = "Work out the sphere's target strength for the water below instead of the raw files' sound speed."});
  v.field("temperature_c", p.temperature_c,
          {.unit = "deg C", .min = -2, .max = 40, .text = "Temperature of the water around the sphere."});
  v.field("salinity_psu", p.salinity_psu,
          {.unit = "psu", .min = 0, .max = 42, .text = "Salinity of the water around the sphere."});
  v.field("depth_m", p.depth_m, {.unit = "m", .min = 0, .max = 1000, .text = "Depth of the sphere."});
}

/// What a sphere run gave.
struct SphereMade {
  SphereCalibration calibration;
  SphereRunParams params;
  SphereChartData chart;
};

/// The calibration page: a sphere run is fitted behind the window as `sonarx calibrate` does it, and shown; its table is
/// written, or used for the open survey. A click on a beam marks it in all plots.
/// threads  the window's
class SpherePage : public LivePicture {
 public:
  /// The app outlives the page. The sphere run is the open survey until another is chosen.
  explicit SpherePage(AppModel& app);
  /// What still runs is given up.
  ~SpherePage() override;
  SpherePage(const SpherePage&) = delete;
  SpherePage& operator=(const SpherePage&) = delete;

  [[nodiscard]] Parameters<SphereAsked>& asked() { return asked_; }
  [[nodiscard]] Parameters<SphereLook>& look() { return look_; }
  /// The sphere's material, as its TS is worked out with it, and the source of that.
  [[nodiscard]] std::string material_text() const;
  [[nodiscard]] const std::vector<std::filesystem::path>& sphere_run() const { return paths_; }
  void choose_sphere_run();

  void start();
  void stop();
  [[nodiscard]] bool running() const { return running_; }
  /// 0 to 1.
  [[nodiscard]] double share() const;
  /// What a user must know.
  [[nodiscard]] const std::string& told() const { return told_; }
  /// Null before the first that came to its end.
  [[nodiscard]] const std::shared_ptr<const SphereMade>& made() const { return made_; }
  [[nodiscard]] std::optional<std::size_t> beam() const { return beam_; }

  /// Asks for a file and writes the calibration table into it.
  void ask_and_write();
  /// Whether the open survey can take the table: it has all the channels.
  [[nodiscard]] bool usable() const;
  /// The open survey is measured with the table from now on: a line of the journal, undo takes it back.
  void use();

  void pointer(const PointerEvent& event) override;
  [[nodiscard]] std::string hint(PixelPoint at) const override;
  /// Of the picture on show; null without one.
  [[nodiscard]] const std::shared_ptr<const SphereChart>& sight() const { return sight_; }

 protected:
  [[nodiscard]] Build build(const PictureLook& look) override;
  void take(const std::shared_ptr<const void>& detail) override;

 private:
  void follow_preset();
  void end(Result<std::shared_ptr<const SphereMade>> made);
  void tell(std::string line);
  [[nodiscard]] SphereChoice choice() const;

  AppModel& app_;
  Parameters<SphereAsked> asked_;
  Parameters<SphereLook> look_;
  SphereAsked before_;
  std::vector<std::filesystem::path> paths_;
  bool running_ = false;
  std::string told_;
  std::shared_ptr<const SphereMade> made_;
  std::optional<std::size_t> beam_;
  std::shared_ptr<const SphereChart> sight_;
  std::shared_ptr<bool> here_ = std::make_shared<bool>(true);
  Listening listening_;  // the last member: it ends first
};

}  // namespace sonar
