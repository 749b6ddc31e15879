// SPDX-License-Identifier: Apache-2.0
// The module sonar_explorer: the library's facade as Python sees it. Arrays are NumPy's and share the library's memory.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <sonar_explorer/error.h>
#include <sonar_explorer/schools.h>
#include <sonar_explorer/stop.h>
#include <sonar_explorer/version.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;
namespace se = sonar_explorer;

namespace {

/// An array of the library's memory, which lives as long as the array. Nobody may write to it.
template <class T, class Owner>
py::array_t<T> view_of(std::span<const T> values, const std::vector<py::ssize_t>& shape, const Owner& owner) {
  const auto keep = py::capsule(new Owner(owner), [](void* held) { delete static_cast<Owner*>(held); });
  py::array_t<T> array(shape, values.data(), keep);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// Runs what takes long beside the interpreter, which other threads use meanwhile; Ctrl-C ends it.
template <class Task>
auto interruptible(Task task) {
  auto done = std::async(std::launch::async, std::move(task));
  for (;;) {
    {
      const py::gil_scoped_release released;
      if (done.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready) break;
    }
    if (PyErr_CheckSignals() == 0) continue;
    {
      // Whatever has not begun its work yet is stopped at the next try.
      const py::gil_scoped_release released;
      do {
        se::stop_running();
      } while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready);
    }
    throw py::error_already_set();
  }
  return done.get();
}

std::vector<py::ssize_t> shape_of(const se::Shape& shape) { return {shape.fans, shape.beams, shape.samples}; }

/// The values moved into an array.
template <class T>
py::array_t<T> array_of(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
  auto held = std::make_shared<std::vector<T>>(std::move(values));
  return view_of<T>(std::span<const T>(*held), shape, held);
}
template <class T>
py::array_t<T> array_of(std::vector<T> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

py::object column_of(const se::Column& column) {
  return std::visit(
      [](const auto& values) -> py::object {
        using Values = std::decay_t<decltype(values)>;
        if constexpr (std::is_same_v<Values, std::vector<std::string>>) {
          py::list texts;
          for (const std::string& text : values) texts.append(text);
          return texts;
        } else {
          return array_of(values);
        }
      },
      column.values);
}

py::dict dict_of(const se::Table& table) {
  py::dict columns;
  for (const se::Column& column : table) columns[column.name.c_str()] = column_of(column);
  return columns;
}

/// xarray.Dataset of a table: along one dimension, with units and long names.
py::object dataset_of(const se::Table& table, const char* dimension) {
  const py::module_ xarray = py::module_::import("xarray");
  py::dict variables;
  for (const se::Column& column : table) {
    py::dict attributes;
    if (!column.unit.empty()) attributes["units"] = column.unit;
    if (!column.long_name.empty()) attributes["long_name"] = column.long_name;
    variables[column.name.c_str()] = py::make_tuple(dimension, column_of(column), attributes);
  }
  return xarray.attr("Dataset")(variables);
}

/// Seeds from a list of (fan, beam, sample), or one of them.
std::vector<se::Seed> seeds_of(const py::object& seeds) {
  const auto seed = [](const py::handle& one) {
    const auto numbers = one.cast<std::vector<int>>();
    if (numbers.size() != 3) throw py::value_error("a seed is (fan, beam, sample)");
    return se::Seed{numbers[0], numbers[1], numbers[2]};
  };
  std::vector<se::Seed> found;
  const py::sequence list = seeds.cast<py::sequence>();
  if (list.size() > 0 && py::isinstance<py::sequence>(list[0])) {
    for (const py::handle one : list) found.push_back(seed(one));
  } else {
    found.push_back(seed(seeds));
  }
  return found;
}

se::GrowOptions options_of(std::optional<double> tolerance_db, std::optional<double> tolerance_opacity,
                           std::optional<std::string> mode) {
  return {tolerance_db, tolerance_opacity, std::move(mode)};
}

/// [ping][fan][beam][sample] would be large: one ping's masks as an array of school numbers.
py::array_t<std::int32_t> school_ids(const se::Product& product, std::int64_t ping) {
  const se::Shape shape = product.shape().value_or(se::Shape{});
  std::vector<std::int32_t> ids(shape.size(), 0);
  for (const se::Mask& mask : product.masks()) {
    if (mask.ping_index != ping) continue;
    for (const se::MaskRun& run : mask.runs) {
      const std::size_t row = static_cast<std::size_t>(run.fan) * static_cast<std::size_t>(shape.beams) +
                              static_cast<std::size_t>(run.beam);
      const std::size_t first =
          row * static_cast<std::size_t>(shape.samples) + static_cast<std::size_t>(run.first_sample);
      std::fill_n(ids.begin() + static_cast<std::ptrdiff_t>(first), run.count,
                  static_cast<std::int32_t>(mask.school_id));
    }
  }
  return array_of(std::move(ids), shape_of(shape));
}

/// Error, with its kind as an attribute.
void bind_error(py::module_& m) {
  static py::exception<se::Error> error(m, "Error");
  error.attr("__doc__") = "What could not be done: one line, as the command line prints it; `kind` says of which kind.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const se::Error& caught) {
      const py::object made = static_cast<const py::object&>(error)(caught.what());
      made.attr("kind") = caught.kind();
      PyErr_SetObject(error.ptr(), made.ptr());
    }
  });
}

void bind_recipe(py::module_& m) {
  py::class_<se::Recipe>(m, "Recipe", "Every parameter of every stage; a value that does not change.")
      .def(py::init<>(), "The preset 'default'.")
      .def_static("preset", &se::Recipe::preset, py::arg("name"),
                  "'default', or 'paper': the article of 2007 to the letter.")
      .def_static("from_json", &se::Recipe::from_json, py::arg("text"), "A recipe from its JSON text.")
      .def_static("from_file", &se::Recipe::from_file, py::arg("path"), "A recipe from a file.")
      .def("to_json", &se::Recipe::to_json, "All parameters, defaults filled in, keys sorted.")
      .def_property_readonly("hash", &se::Recipe::hash, "Equal recipes have equal hashes.")
      .def(
          "with_value",
          [](const se::Recipe& recipe, const std::string& name, const py::object& value) {
            return recipe.with(name, py::module_::import("json").attr("dumps")(value).cast<std::string>());
          },
          py::arg("name"), py::arg("value"),
          "The same with another value: recipe.with_value('detect.tolerance_db', 8.5).");
}

void bind_ping(py::module_& m) {
  py::class_<se::Ping>(m, "Ping", "One ping's samples. Arrays are [fan][beam][sample] views, read-only, not copied.")
      .def_property_readonly(
          "shape", [](const se::Ping& p) { return py::make_tuple(p.shape().fans, p.shape().beams, p.shape().samples); },
          "(fans, beams, samples)")
      .def_property_readonly(
          "power", [](const se::Ping& p) { return view_of<std::int16_t>(p.power(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: received power, counts of 10 log10(2)/256 dB re 1 W; -32768 = not recorded")
      .def_property_readonly(
          "sv", [](const se::Ping& p) { return view_of<std::int16_t>(p.sv(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: Sv as calibrated, counts of 10 log10(2)/256 dB re 1 m-1; -32768 = none")
      .def_property_readonly(
          "sv_filtered",
          [](const se::Ping& p) { return view_of<std::int16_t>(p.sv_filtered(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: Sv after the median filter, in which schools are grown and detected")
      .def_property_readonly(
          "flags", [](const se::Ping& p) { return view_of<std::uint8_t>(p.flags(), shape_of(p.shape()), p); },
          "uint8 [fan][beam][sample]: bits NEAR_FIELD, SURFACE, CORRUPTED_PACKETS, DROPOUT, INTERFERENCE, "
          "IMPULSE_NOISE, SEABED, LOW_SNR; 0 = sound")
      .def_property_readonly(
          "background_power_db",
          [](const se::Ping& p) {
            return view_of<double>(p.background_power_db(), {p.shape().fans, p.shape().beams}, p);
          },
          "float64 [fan][beam]: noise power that is subtracted, dB re 1 W; NaN = none known");
}

void bind_survey(py::module_& m) {
  py::class_<se::Grid>(m, "Grid", "Directions and ranges of an observation's samples.")
      .def_property_readonly(
          "elevation_deg", [](const se::Grid& g) { return array_of(g.elevation_deg); }, "[fan] positive up")
      .def_property_readonly(
          "azimuth_deg", [](const se::Grid& g) { return array_of(g.azimuth_deg); }, "[beam] clockwise from the bow")
      .def_property_readonly(
          "frequency_hz", [](const se::Grid& g) { return array_of(g.frequency_hz); }, "[fan] transmitted, Hz")
      .def_property_readonly(
          "range_m", [](const se::Grid& g) { return array_of(g.range_m); }, "[sample] slant range from the transducer")
      .def_property_readonly(
          "shape", [](const se::Grid& g) { return py::make_tuple(g.shape().fans, g.shape().beams, g.shape().samples); },
          "(fans, beams, samples)")
      .def_property_readonly(
          "channel",
          [](const se::Grid& g) {
            return array_of(g.channel, {g.shape().fans, g.shape().beams});
          },
          "[fan][beam] number of the channel in the files, from 0");
  py::class_<se::PingPlace>(m, "PingPlace", "When and where a ping was made; NaN = unknown.")
      .def_readonly("time_ns", &se::PingPlace::time_ns, "nanoseconds since 1970, UTC: the ping's lasting key")
      .def_readonly("latitude_deg", &se::PingPlace::latitude_deg, "degrees north, WGS 84")
      .def_readonly("longitude_deg", &se::PingPlace::longitude_deg, "degrees east, WGS 84")
      .def_readonly("heading_deg", &se::PingPlace::heading_deg, "clockwise from true north")
      .def_readonly("speed_mps", &se::PingPlace::speed_mps, "over ground, m/s")
      .def_readonly("pitch_deg", &se::PingPlace::pitch_deg, "positive bow up")
      .def_readonly("roll_deg", &se::PingPlace::roll_deg, "positive port up")
      .def_readonly("transducer_depth_m", &se::PingPlace::transducer_depth_m, "below the water's surface, m")
      .def_readonly("bad", &se::PingPlace::bad, "left out everywhere");
  py::class_<se::Observation>(m, "Observation", "A run of pings of one sounder on one beam grid.")
      .def_property_readonly("name", &se::Observation::name, "such as 'obs-0001'")
      .def_property_readonly("sounder", &se::Observation::sounder, "as the files name it")
      .def_property_readonly("files", &se::Observation::files, "names without folder")
      .def("__len__", &se::Observation::pings, "number of pings")
      .def_property_readonly("places", &se::Observation::places, "when and where each ping was made")
      .def_property_readonly("grid", &se::Observation::grid, "None where the beams make no grid of fans and beams")
      .def_property_readonly(
          "cell_volumes_m3",
          [](const se::Observation& o) {
            const auto grid = o.grid();
            return array_of(o.cell_volumes_m3(), grid ? shape_of(grid->shape()) : std::vector<py::ssize_t>{0});
          },
          "float64 [fan][beam][sample]: volume of each cell, m3")
      .def("ping", &se::Observation::ping, py::arg("index"), py::call_guard<py::gil_scoped_release>(),
           "Reads and processes one ping.")
      .def("__repr__", [](const se::Observation& o) {
        return "<Observation " + o.name() + ", " + std::to_string(o.pings()) + " pings>";
      });
  py::class_<se::Survey>(m, "Survey", "A survey's raw files, which are never written to.")
      .def_property_readonly("observations", &se::Survey::observations, "in time order")
      .def("observation", &se::Survey::observation, py::arg("name"), py::return_value_policy::copy, "by its name")
      .def_property_readonly("notes", &se::Survey::notes, "what is wrong with the files, a line each");
  m.def(
      "open_survey",
      [](const py::object& paths, const se::Recipe& recipe, int threads) {
        std::vector<std::filesystem::path> list;
        if (py::isinstance<py::list>(paths) || py::isinstance<py::tuple>(paths)) {
          list = paths.cast<std::vector<std::filesystem::path>>();
        } else {
          list.push_back(paths.cast<std::filesystem::path>());
        }
        return interruptible([&] { return se::Survey::open(list, recipe, threads); });
      },
      py::arg("paths"), py::arg("recipe") = se::Recipe(), py::arg("threads") = 0,
      "Opens a folder of raw files, a raw file, or a list of them. threads: 0 = all of the machine's.");
}

void bind_product(py::module_& m) {
  py::class_<se::MaskRun>(m, "MaskRun", "Neighbouring samples of one beam.")
      .def(py::init([](int fan, int beam, int first_sample, int count) {
             return se::MaskRun{fan, beam, first_sample, count};
           }),
           py::arg("fan"), py::arg("beam"), py::arg("first_sample"), py::arg("count"))
      .def_readwrite("fan", &se::MaskRun::fan, "from 0, the deepest")
      .def_readwrite("beam", &se::MaskRun::beam, "from 0, as in the arrays")
      .def_readwrite("first_sample", &se::MaskRun::first_sample, "from 0, the nearest")
      .def_readwrite("count", &se::MaskRun::count, "number of samples");
  py::class_<se::Mask>(m, "Mask", "A school's voxels in one ping.")
      .def(py::init<>())
      .def_readwrite("school_id", &se::Mask::school_id, "number of the school in its observation, from 1")
      .def_readwrite("ping_index", &se::Mask::ping_index, "from 0, in the observation")
      .def_readwrite("runs", &se::Mask::runs, "sorted by fan, beam and sample, without overlap")
      .def_readwrite("confidence", &se::Mask::confidence, "of each voxel in the order of the runs, 1 to 255 for 255 f");
  py::class_<se::Product>(m, "Product", "What was found in an observation: schools, their masks and figures.")
      .def_property_readonly("observation", &se::Product::observation, "name of its observation")
      .def_property_readonly("recipe_json", &se::Product::recipe_json, "the recipe that it was made with")
      .def_property_readonly(
          "schools", [](const se::Product& p) { return dict_of(p.schools()); }, "columns of schools.csv by name")
      .def_property_readonly(
          "school_pings", [](const se::Product& p) { return dict_of(p.school_pings()); },
          "columns of school_pings.csv by name")
      .def_property_readonly(
          "rejected", [](const se::Product& p) { return dict_of(p.rejected()); },
          "echoes that were judged not to be schools, by column")
      .def(
          "schools_dataset", [](const se::Product& p) { return dataset_of(p.schools(), "school"); },
          "xarray.Dataset of the schools, with units")
      .def(
          "school_pings_dataset", [](const se::Product& p) { return dataset_of(p.school_pings(), "row"); },
          "xarray.Dataset of schools in pings, with units")
      .def_property_readonly("masks", &se::Product::masks, "a list of Mask, by ping and school")
      .def("school_ids", &school_ids, py::arg("ping"),
           "int32 [fan][beam][sample]: the school of each voxel of a ping; 0 = none")
      .def_property_readonly("notes", &se::Product::notes, "what is worth knowing, a line each")
      .def("with_masks", &se::Product::with_masks, py::arg("masks"),
           "The same with other masks; measure() works out their figures.")
      .def("write", &se::Product::write, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
           "One netCDF file, whole or not at all.");
  m.def("read_product", &se::Product::read, py::arg("path"), py::call_guard<py::gil_scoped_release>(),
        "Reads products/obs-0001.nc of a result.");
}

void bind_schools(py::module_& m) {
  m.def(
      "detect", [](const se::Observation& o) { return interruptible([&] { return se::detect(o); }); },
      py::arg("observation"),
      "Schools of an observation, detected, tracked and measured: what `sonarx run` makes of it. Returns a Product.");
  m.def(
      "grow",
      [](const se::Observation& o, std::size_t ping, const py::object& seeds, std::optional<double> db,
         std::optional<double> opacity, std::optional<std::string> mode) {
        const auto list = seeds_of(seeds);
        const se::GrowOptions options = options_of(db, opacity, std::move(mode));
        return interruptible([&] { return se::grow(o, ping, list, options); });
      },
      py::arg("observation"), py::arg("ping"), py::arg("seeds"), py::arg("tolerance_db") = py::none(),
      py::arg("tolerance_opacity") = py::none(), py::arg("mode") = py::none(),
      "One school in one ping, as a click selects it. seeds: (fan, beam, sample) from 0, or a list of them. Returns a "
      "Product.");
  m.def(
      "propagate",
      [](const se::Observation& o, std::size_t ping, const py::object& seeds, std::int64_t reach,
         std::optional<double> db, std::optional<double> opacity, std::optional<std::string> mode) {
        const auto list = seeds_of(seeds);
        const se::GrowOptions options = options_of(db, opacity, std::move(mode));
        return interruptible([&] { return se::propagate(o, ping, list, reach, options); });
      },
      py::arg("observation"), py::arg("ping"), py::arg("seeds"), py::arg("reach") = -1,
      py::arg("tolerance_db") = py::none(), py::arg("tolerance_opacity") = py::none(), py::arg("mode") = py::none(),
      "The same, followed through the pings before and after: `reach` of them to each side, negative = as far as it "
      "goes.");
  m.def(
      "measure",
      [](const se::Observation& o, const se::Product& product) {
        return interruptible([&] { return se::measure(o, product); });
      },
      py::arg("observation"), py::arg("product"),
      "All figures of a product's masks worked out anew, under the recipe that the survey was opened with.");
}

}  // namespace

PYBIND11_MODULE(sonar_explorer, m) {
  m.doc() =
      "Fish schools in 4D fishery-sonar surveys: open a survey, look at pings, select, detect and measure schools.";
  m.attr("__version__") = se::version();
  m.attr("DB_PER_COUNT") = se::kDbPerCount;
  m.attr("NO_DATA") = se::kNoData;
  m.attr("NEAR_FIELD") = int{se::kNearField};
  m.attr("SURFACE") = int{se::kSurface};
  m.attr("CORRUPTED_PACKETS") = int{se::kCorruptedPackets};
  m.attr("DROPOUT") = int{se::kDropout};
  m.attr("INTERFERENCE") = int{se::kInterference};
  m.attr("IMPULSE_NOISE") = int{se::kImpulseNoise};
  m.attr("SEABED") = int{se::kSeabed};
  m.attr("LOW_SNR") = int{se::kLowSnr};
  bind_error(m);
  bind_recipe(m);
  bind_ping(m);
  bind_survey(m);
  bind_product(m);
  bind_schools(m);
}
