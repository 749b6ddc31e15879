// SPDX-License-Identifier: Apache-2.0
#include <sonar_explorer/ping.h>
#include <sonar_explorer/survey.h>

#include <cstdint>

#include "arrays.h"
#include "bindings.h"

namespace py = pybind11;

namespace sonar_explorer::python {
namespace {

void bind_ping(py::module_& m) {
  py::class_<Ping>(m, "Ping", "One ping's samples. Arrays are [fan][beam][sample] views, read-only, not copied.")
      .def_property_readonly(
          "shape", [](const Ping& p) { return tuple_of(p.shape()); }, "(fans, beams, samples)")
      .def_property_readonly(
          "power", [](const Ping& p) { return view_of<std::int16_t>(p.power(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: received power, counts of 10 log10(2)/256 dB re 1 W; -32768 = not recorded")
      .def_property_readonly(
          "sv", [](const Ping& p) { return view_of<std::int16_t>(p.sv(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: Sv as calibrated, counts of 10 log10(2)/256 dB re 1 m-1; -32768 = none")
      .def_property_readonly(
          "sv_filtered", [](const Ping& p) { return view_of<std::int16_t>(p.sv_filtered(), shape_of(p.shape()), p); },
          "int16 [fan][beam][sample]: Sv after the median filter, in which schools are grown and detected, counts of "
          "10 log10(2)/256 dB re 1 m-1; -32768 = none")
      .def_property_readonly(
          "flags", [](const Ping& p) { return view_of<std::uint8_t>(p.flags(), shape_of(p.shape()), p); },
          "uint8 [fan][beam][sample]: bits NEAR_FIELD, SURFACE, CORRUPTED_PACKETS, DROPOUT, INTERFERENCE, "
          "IMPULSE_NOISE, SEABED, LOW_SNR; 0 = sound")
      .def_property_readonly(
          "background_power_db",
          [](const Ping& p) {
            return view_of<double>(p.background_power_db(), {p.shape().fans, p.shape().beams}, p);
          },
          "float64 [fan][beam]: noise power that is subtracted, dB re 1 W; NaN = none known")
      .def("__repr__", [](const Ping& p) {
        return words_of("<Ping, {} fans, {} beams, {} samples>", p.shape().fans, p.shape().beams, p.shape().samples);
      });
}

void bind_grid(py::module_& m) {
  py::class_<Grid>(m, "Grid", "Directions and ranges of an observation's samples.")
      .def_property_readonly(
          "elevation_deg", [](const Grid& g) { return array_of(g.elevation_deg); },
          "float64 [fan]: elevation of the fan, degrees, positive up")
      .def_property_readonly(
          "azimuth_deg", [](const Grid& g) { return array_of(g.azimuth_deg); },
          "float64 [beam]: azimuth of the beam, degrees clockwise from the bow")
      .def_property_readonly(
          "frequency_hz", [](const Grid& g) { return array_of(g.frequency_hz); },
          "float64 [fan]: transmitted frequency, Hz")
      .def_property_readonly(
          "range_m", [](const Grid& g) { return array_of(g.range_m); },
          "float64 [sample]: slant range from the transducer, m")
      .def_property_readonly(
          "shape", [](const Grid& g) { return tuple_of(g.shape()); }, "(fans, beams, samples)")
      .def_property_readonly(
          "channel",
          [](const Grid& g) {
            return array_of(g.channel, {g.shape().fans, g.shape().beams});
          },
          "int32 [fan][beam]: number of the channel in the files, from 0")
      .def("__repr__", [](const Grid& g) {
        return words_of("<Grid, {} fans, {} beams, {} samples>", g.shape().fans, g.shape().beams, g.shape().samples);
      });
}

void bind_place(py::module_& m) {
  py::class_<PingPlace>(m, "PingPlace", "When and where a ping was made; NaN = unknown.")
      .def_readonly("time_ns", &PingPlace::time_ns, "nanoseconds since 1970, UTC: the ping's lasting key")
      .def_readonly("latitude_deg", &PingPlace::latitude_deg, "degrees north, WGS 84")
      .def_readonly("longitude_deg", &PingPlace::longitude_deg, "degrees east, WGS 84")
      .def_readonly("heading_deg", &PingPlace::heading_deg, "degrees clockwise from true north")
      .def_readonly("speed_mps", &PingPlace::speed_mps, "over ground, m/s")
      .def_readonly("pitch_deg", &PingPlace::pitch_deg, "degrees, positive bow up")
      .def_readonly("roll_deg", &PingPlace::roll_deg, "degrees, positive port up")
      .def_readonly("transducer_depth_m", &PingPlace::transducer_depth_m, "below the water's surface, m")
      .def_readonly("bad", &PingPlace::bad, "bool: left out everywhere")
      .def("__repr__", [](const PingPlace& p) {
        const py::object time = py::module_::import("numpy").attr("datetime64")(p.time_ns, "ns");
        return words_of("<PingPlace {} UTC, latitude {:.5f}, longitude {:.5f}{}>", py::str(time), p.latitude_deg,
                        p.longitude_deg, p.bad ? ", bad" : "");
      });
}

}  // namespace

void bind_pings(py::module_& m) {
  bind_ping(m);
  bind_grid(m);
  bind_place(m);
}

}  // namespace sonar_explorer::python
