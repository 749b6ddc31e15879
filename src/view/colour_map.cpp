// SPDX-License-Identifier: Apache-2.0
// Sources of the tables: EK500 as echopype and echopy publish it (colours of Simrad's EK500 sounder). viridis and
// cividis: matplotlib's _cm_listed.py, CC0 (van der Walt and Smith 2015; Nunez, Anderton and Renslow 2018). thermal,
// haline, dense, deep: cmocean, copyright 2015 Kristen M. Thyng, MIT licence (Thyng et al. 2016,
// doi:10.5670/oceanog.2016.66). Every 5th of their 256 colours is kept and the rest interpolated, which
// is off by 1 of 255 at most (by 4 at the kink of cividis, in its darkest tenth).
#include "view/colour_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sonar {
namespace {

constexpr std::array<std::string_view, kColourMaps> kNames = {
    "ek500", "ek500-smooth", "viridis", "cividis", "thermal", "haline", "dense", "deep", "grey", "grey-inverted"};

constexpr std::array<Rgba8, 12> kEk500 = {{{159, 159, 159, 255},
                                           {95, 95, 95, 255},
                                           {0, 0, 255, 255},
                                           {0, 0, 127, 255},
                                           {0, 191, 0, 255},
                                           {0, 127, 0, 255},
                                           {255, 255, 0, 255},
                                           {255, 127, 0, 255},
                                           {255, 0, 191, 255},
                                           {255, 0, 0, 255},
                                           {166, 83, 60, 255},
                                           {120, 60, 40, 255}}};
constexpr std::array<std::uint32_t, 52> kViridis = {
    0x440154, 0x46085C, 0x471063, 0x481769, 0x481D6F, 0x482475, 0x472A7A, 0x46307E, 0x453781, 0x433D84, 0x414287,
    0x3F4889, 0x3D4E8A, 0x3A538B, 0x38598C, 0x355E8D, 0x33638D, 0x31688E, 0x2E6D8E, 0x2C718E, 0x2A768E, 0x297B8E,
    0x27808E, 0x25848E, 0x23898E, 0x218E8D, 0x20928C, 0x1F978B, 0x1E9C89, 0x1FA188, 0x21A585, 0x24AA83, 0x28AE80,
    0x2EB37C, 0x35B779, 0x3DBC74, 0x46C06F, 0x50C46A, 0x5AC864, 0x65CB5E, 0x70CF57, 0x7CD250, 0x89D548, 0x95D840,
    0xA2DA37, 0xB0DD2F, 0xBDDF26, 0xCAE11F, 0xD8E219, 0xE5E419, 0xF1E51D, 0xFDE725,
};
constexpr std::array<std::uint32_t, 52> kCividis = {
    0x00224E, 0x002656, 0x002A5F, 0x002D68, 0x003070, 0x083370, 0x163770, 0x203A6F, 0x273E6E, 0x2E416D, 0x34456C,
    0x3A486C, 0x3F4C6C, 0x444F6C, 0x49536C, 0x4E566C, 0x535A6D, 0x575D6D, 0x5C616E, 0x60646F, 0x656870, 0x696B71,
    0x6D6F72, 0x727274, 0x767676, 0x7A7A78, 0x7E7D78, 0x838179, 0x888578, 0x8D8878, 0x928C78, 0x969077, 0x9B9476,
    0xA09875, 0xA59C74, 0xAAA073, 0xAFA471, 0xB5A86F, 0xBAAC6D, 0xBFB06B, 0xC4B468, 0xC9B965, 0xCFBD62, 0xD4C15F,
    0xDAC65B, 0xDFCA57, 0xE5CF52, 0xEAD34C, 0xF0D846, 0xF6DD3F, 0xFCE236, 0xFEE838,
};
constexpr std::array<std::uint32_t, 52> kThermal = {
    0x042333, 0x05273D, 0x062A47, 0x082D52, 0x0B305D, 0x0F326A, 0x163377, 0x1E3484, 0x273491, 0x33339B, 0x3E349F,
    0x4736A0, 0x50399E, 0x583C9C, 0x5F3F99, 0x664397, 0x6D4694, 0x744992, 0x7A4C91, 0x814F8F, 0x88528D, 0x8F548C,
    0x96578A, 0x9D5988, 0xA55C86, 0xAC5E83, 0xB46080, 0xBB627D, 0xC36579, 0xCA6774, 0xD16A6F, 0xD86D6A, 0xDF7064,
    0xE5745E, 0xEB7958, 0xEF7E52, 0xF3834C, 0xF68A47, 0xF99143, 0xFA983F, 0xFB9F3D, 0xFCA73C, 0xFCAF3C, 0xFBB73D,
    0xFABF3F, 0xF9C842, 0xF7D045, 0xF5D849, 0xF2E14D, 0xEFE951, 0xECF256, 0xE8FA5B,
};
constexpr std::array<std::uint32_t, 52> kHaline = {
    0x2A186C, 0x2C1A78, 0x2E1B84, 0x2E1D91, 0x2D209C, 0x2927A2, 0x2230A3, 0x1C39A0, 0x16409D, 0x11479A, 0x0D4D97,
    0x0C5294, 0x0D5792, 0x105C90, 0x14618E, 0x18658D, 0x1C6A8C, 0x206E8B, 0x24728A, 0x287689, 0x2B7B89, 0x2F7F89,
    0x328388, 0x358888, 0x388C88, 0x3A9087, 0x3D9587, 0x3F9986, 0x429E85, 0x45A384, 0x48A782, 0x4CAC80, 0x50B07E,
    0x54B57B, 0x5AB978, 0x5FBE75, 0x66C271, 0x6EC66D, 0x77CA68, 0x80CE64, 0x8BD160, 0x97D45D, 0xA3D75C, 0xAFD95D,
    0xBBDB61, 0xC6DE66, 0xD0E06D, 0xDAE375, 0xE3E67E, 0xECE987, 0xF5EC90, 0xFDEF9A,
};
constexpr std::array<std::uint32_t, 52> kDense = {
    0xE6F1F1, 0xDDEDED, 0xD5E9EB, 0xCCE4E8, 0xC4E0E6, 0xBCDCE5, 0xB4D8E4, 0xACD4E3, 0xA5CFE2, 0x9ECBE2, 0x97C6E2,
    0x90C2E2, 0x8ABDE3, 0x85B8E3, 0x80B3E3, 0x7CAEE4, 0x79A9E4, 0x76A4E5, 0x759EE5, 0x7498E4, 0x7393E3, 0x748DE2,
    0x7487E0, 0x7581DE, 0x767BDB, 0x7775D7, 0x786FD3, 0x7969CF, 0x7963CA, 0x795DC4, 0x7958BF, 0x7952B8, 0x784DB2,
    0x7748AB, 0x7642A5, 0x753D9D, 0x733996, 0x72348F, 0x6F2F87, 0x6D2B7F, 0x6A2777, 0x67236F, 0x641F67, 0x601C5E,
    0x5C1956, 0x58174E, 0x531546, 0x4E133E, 0x481237, 0x421130, 0x3C102A, 0x360E24,
};
constexpr std::array<std::uint32_t, 52> kDeep = {
    0xFDFECC, 0xF3FAC6, 0xE9F6C0, 0xDFF2BB, 0xD4EFB6, 0xCAEBB2, 0xBFE7AE, 0xB5E4AA, 0xAAE0A8, 0x9FDDA5, 0x94D9A4,
    0x89D5A3, 0x7FD1A3, 0x76CDA3, 0x6EC8A3, 0x67C3A4, 0x62BFA4, 0x5DBAA4, 0x59B4A4, 0x56AFA4, 0x53AAA3, 0x51A5A2,
    0x4FA0A2, 0x4D9BA1, 0x4B96A0, 0x49919E, 0x478C9D, 0x46879C, 0x44829B, 0x437D9A, 0x417899, 0x407398, 0x3F6E97,
    0x3E6996, 0x3E6495, 0x3E5F93, 0x3E5992, 0x3F5490, 0x404E8D, 0x414988, 0x414481, 0x41407A, 0x403C71, 0x3F3869,
    0x3D3461, 0x3A3058, 0x382D51, 0x352949, 0x322541, 0x2F223A, 0x2B1E33, 0x281A2C,
};
constexpr std::array<Rgba8, 2> kGrey = {{{0, 0, 0, 255}, {255, 255, 255, 255}}};
constexpr std::array<Rgba8, 2> kGreyInverted = {{{255, 255, 255, 255}, {0, 0, 0, 255}}};

/// From 0xRRGGBB.
template <std::size_t N>
ColourMap map_of(const std::array<std::uint32_t, N>& knots) {
  ColourMap map;
  for (const std::uint32_t rgb : knots) {
    map.knots.push_back({static_cast<std::uint8_t>(rgb >> 16U), static_cast<std::uint8_t>((rgb >> 8U) & 255U),
                         static_cast<std::uint8_t>(rgb & 255U), 255});
  }
  return map;
}

template <std::size_t N>
ColourMap map_of(const std::array<Rgba8, N>& knots, bool stepped = false) {
  return {{knots.begin(), knots.end()}, stepped};
}

std::uint8_t mixed(std::uint8_t a, std::uint8_t b, double weight_of_b) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * weight_of_b));
}

double linear_light(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

std::span<const std::string_view> colour_map_names() { return kNames; }

std::optional<ColourMapName> colour_map_named(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<ColourMapName>(found - kNames.begin());
}

Rgba8 ColourMap::at(double t) const {
  if (knots.empty()) return {};
  const double c = std::isnan(t) ? 0.0 : std::clamp(t, 0.0, 1.0);
  const std::size_t last = knots.size() - 1;
  if (stepped) return knots[std::min(last, static_cast<std::size_t>(c * static_cast<double>(knots.size())))];
  const double place = c * static_cast<double>(last);
  const std::size_t below = std::min(last > 0 ? last - 1 : 0, static_cast<std::size_t>(place));
  const Rgba8 a = knots[below];
  const Rgba8 b = knots[std::min(last, below + 1)];
  const double weight = place - static_cast<double>(below);
  return {mixed(a.r, b.r, weight), mixed(a.g, b.g, weight), mixed(a.b, b.b, weight), 255};
}

const ColourMap& colour_map(ColourMapName name) {
  static const std::array<ColourMap, kColourMaps> maps = {
      map_of(kEk500, true), map_of(kEk500), map_of(kViridis), map_of(kCividis), map_of(kThermal),
      map_of(kHaline),      map_of(kDense), map_of(kDeep),    map_of(kGrey),    map_of(kGreyInverted)};
  return maps[std::min(static_cast<std::size_t>(name), maps.size() - 1)];
}

double lightness(Rgba8 colour) {
  const double y = 0.2126 * linear_light(colour.r) + 0.7152 * linear_light(colour.g) + 0.0722 * linear_light(colour.b);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : y * 24389.0 / 27.0;
}

}  // namespace sonar
