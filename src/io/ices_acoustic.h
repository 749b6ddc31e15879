// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "model/integration.h"
#include "model/product.h"

namespace sonar {

/// Which part of the backscatter is told.
enum class IcesPart : std::uint8_t { all, schools };

/// Echo integration in the acoustic XML of the ICES data centre, which StoX (RstoxData) reads: a Log for each EDSU, with its
/// middle's time, place and distance, and a Sample for each depth channel, whose NASC (Type C, m2 nmi-2) is the mean s_v over
/// all ranges times the channel's height: those of a Log add up to nasc_m2_nmi2 of effort.csv. An EDSU without a place is left
/// out.
/// product  of the survey, for what is told of the instrument; what no product knows (ship, country, survey, location of the
///          transducer, power, pulse length, gain, calibration) is NaN or a code for unknown, and a comment lists it
/// source   schema icesAcoustic.xsd of RstoxData, and the ICES vocabularies that it names
[[nodiscard]] std::string ices_acoustic_xml(const ObservationProduct& product, std::span<const EffortRow> effort,
                                            std::span<const NascRow> nasc, IcesPart part);

}  // namespace sonar
