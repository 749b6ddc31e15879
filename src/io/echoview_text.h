// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "model/product.h"

namespace sonar {

// Echoview's text formats, as its version 7 of regions and 3 of lines have them: UTF-8 with byte order mark, lines ended by
// CR LF.

/// The class of a school without a species.
inline constexpr const char* kNoSpecies = "school";

/// Regions (.evr) of one fan, seen as an echogram over time: a closed polygon for each stretch of neighbouring pings in which a
/// school has voxels there, from half a ping interval before the first to half a one after the last. Depth is the slant range
/// from the transducer: the axis of a fan that looks sideways. Name = "obs-0001/3", class = species, else "school". Notes tell
/// the fan, its beams and the cells of each ping, as cells_of() reads them back (io/echoview_reader.h).
/// product  with its masks and a grid; rejected schools are left out
/// out      empty where no school has a voxel in the fan
/// source   formats of OSOceanAcoustics/echoregions and EchoJulia/EchoviewEvr.jl
[[nodiscard]] std::string evr_text(const ObservationProduct& product, int fan);

/// The seabed (.evl): a point for each ping in which schools tell its depth (their median), m below the sea surface, unverified.
/// out  empty where none does
[[nodiscard]] std::string evl_text(const ObservationProduct& product);

}  // namespace sonar
