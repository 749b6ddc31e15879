// SPDX-License-Identifier: Apache-2.0
#include "signal/excess_kernels.h"

#include <cstddef>

#include "base/check.h"
#include "base/units.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "signal/excess_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sonar::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Calls act(tag, i) for each vector of values, and for each single one that is left.
template <class Value, class Act>
HWY_INLINE void ForEachVector(std::size_t size, const Act& act) {
  const hn::ScalableTag<Value> d;
  const hn::CappedTag<Value, 1> single;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= size; i += hn::Lanes(d)) act(d, i);
  for (; i < size; ++i) act(single, i);
}

/// Marks of 0.
template <class D>
HWY_INLINE auto Unmarked(D d, const std::uint8_t* marks) {
  const hn::Rebind<std::uint8_t, D> bytes;
  const hn::RebindToUnsigned<D> words;
  return hn::Eq(hn::BitCast(d, hn::PromoteTo(words, hn::LoadU(bytes, marks))), hn::Zero(d));
}

/// Counts as numbers, and which of them are data.
template <class D>
struct Numbers {
  hn::Vec<D> value;
  hn::Mask<D> known;
};
template <class D>
HWY_INLINE Numbers<D> load_counts(D d, const std::int16_t* counts) {
  const hn::RebindToSigned<D> ints;
  const hn::Rebind<std::int16_t, D> shorts;
  const auto wide = hn::PromoteTo(ints, hn::LoadU(shorts, counts));
  return {hn::ConvertTo(d, wide), hn::RebindMask(d, hn::Gt(wide, hn::Set(ints, std::int32_t{kNoData})))};
}

void CopyUnmarked(const std::int16_t* values, const std::uint8_t* marks, std::int16_t* out, std::size_t size) {
  ForEachVector<std::int16_t>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto kept = hn::IfThenElse(Unmarked(d, marks + i), hn::LoadU(d, values + i), hn::Set(d, kNoData));
    hn::StoreU(kept, d, out + i);
  });
}

void ExcessOver(const std::int16_t* level, const std::int16_t* water, const std::int16_t* noise, std::int16_t* out,
                std::size_t size) {
  ForEachVector<std::int16_t>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto none = hn::Set(d, kNoData);
    const auto here = hn::LoadU(d, level + i);
    const auto below = hn::Max(hn::LoadU(d, water + i), hn::LoadU(d, noise + i));
    const auto above = hn::SaturatedSub(here, below);
    const auto within = hn::Max(hn::Min(above, hn::Set(d, std::int16_t{30000})), hn::Set(d, std::int16_t{-30000}));
    const auto known = hn::And(hn::Gt(here, none), hn::Gt(below, hn::Set(d, kMinCount)));
    hn::StoreU(hn::IfThenElse(known, within, none), d, out + i);
  });
}

void ClipExcess(const std::int16_t* excess, const std::int16_t* clip, const std::uint8_t* marks, std::int16_t* out,
                std::size_t size) {
  ForEachVector<std::int16_t>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto none = hn::Set(d, kNoData);
    const auto here = hn::LoadU(d, excess + i);
    const auto most = hn::LoadU(d, clip + i);
    const auto within = hn::Max(hn::Min(here, most), hn::Sub(hn::Zero(d), most));
    const auto known = hn::And(Unmarked(d, marks + i), hn::Gt(here, none));
    hn::StoreU(hn::IfThenElse(known, within, none), d, out + i);
  });
}

void TakeOffSteps(const std::int8_t* steps, std::int16_t step, std::int16_t* excess, std::size_t size) {
  ForEachVector<std::int16_t>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::Rebind<std::int8_t, decltype(d)> bytes;
    const auto here = hn::LoadU(d, excess + i);
    const auto by = hn::Mul(hn::PromoteTo(d, hn::LoadU(bytes, steps + i)), hn::Set(d, step));
    const auto left = hn::Sub(here, by);
    hn::StoreU(hn::IfThenElse(hn::Gt(here, hn::Set(d, kNoData)), left, here), d, excess + i);
  });
}

void Whiten(const std::int16_t* excess, const float* middle, const float* scale, float* whitened, float* number,
            std::size_t size) {
  ForEachVector<float>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const auto here = load_counts(d, excess + i);
    const auto by = hn::LoadU(d, scale + i);
    const auto known = hn::And(here.known, hn::Gt(by, hn::Zero(d)));
    const auto value = hn::Mul(hn::Sub(here.value, hn::LoadU(d, middle + i)), by);
    hn::StoreU(hn::IfThenElseZero(known, value), d, whitened + i);
    hn::StoreU(hn::IfThenElseZero(known, hn::Set(d, 1.0F)), d, number + i);
  });
}

void OverRoot(const std::int16_t* excess, const float* sum, const float* number, std::int16_t* out, std::size_t size) {
  ForEachVector<float>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(d)> ints;
    const hn::Rebind<std::int16_t, decltype(d)> shorts;
    const auto one = hn::Set(d, 1.0F);
    const auto of = hn::LoadU(d, number + i);
    const auto mean = hn::Mul(hn::LoadU(d, sum + i), hn::Div(one, hn::Sqrt(hn::Max(of, one))));
    const auto within = hn::Max(hn::Min(mean, hn::Set(d, 32000.0F)), hn::Set(d, -32000.0F));
    const auto known = hn::And(load_counts(d, excess + i).known, hn::Gt(of, hn::Zero(d)));
    const auto told =
        hn::IfThenElse(hn::RebindMask(ints, known), hn::ConvertTo(ints, within), hn::Set(ints, std::int32_t{kNoData}));
    hn::StoreU(hn::DemoteTo(shorts, told), shorts, out + i);
  });
}

void RoundedSteps(const float* sum, const float* number, float least, float step, std::int8_t* out, std::size_t size) {
  ForEachVector<float>(size, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::RebindToSigned<decltype(d)> ints;
    const hn::Rebind<std::int8_t, decltype(d)> bytes;
    const auto half = hn::Set(d, 0.5F);
    const auto of = hn::LoadU(d, number + i);
    const auto mean = hn::Div(hn::LoadU(d, sum + i), hn::Max(of, hn::Set(d, 1.0F)));
    const auto steps = hn::Div(mean, hn::Set(d, step));
    const auto within = hn::Max(hn::Min(steps, hn::Set(d, 127.0F)), hn::Set(d, -127.0F));
    const auto rounded = hn::Add(within, hn::CopySign(half, within));
    const auto told = hn::IfThenElseZero(hn::Ge(of, hn::Set(d, least)), rounded);
    hn::StoreU(hn::DemoteTo(bytes, hn::ConvertTo(ints, told)), bytes, out + i);
  });
}

}  // namespace
}  // namespace sonar::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sonar {

namespace {
HWY_EXPORT(CopyUnmarked);
HWY_EXPORT(ExcessOver);
HWY_EXPORT(ClipExcess);
HWY_EXPORT(TakeOffSteps);
HWY_EXPORT(Whiten);
HWY_EXPORT(OverRoot);
HWY_EXPORT(RoundedSteps);
}  // namespace

void copy_unmarked(std::span<const std::int16_t> values, std::span<const std::uint8_t> marks,
                   std::span<std::int16_t> out) {
  SONAR_CHECK(marks.size() == values.size() && out.size() == values.size());
  HWY_DYNAMIC_DISPATCH(CopyUnmarked)(values.data(), marks.data(), out.data(), out.size());
}

void excess_over(std::span<const std::int16_t> level, std::span<const std::int16_t> water,
                 std::span<const std::int16_t> noise, std::span<std::int16_t> out) {
  SONAR_CHECK(level.size() == out.size() && water.size() == out.size() && noise.size() == out.size());
  HWY_DYNAMIC_DISPATCH(ExcessOver)(level.data(), water.data(), noise.data(), out.data(), out.size());
}

void clip_excess(std::span<const std::int16_t> excess, std::span<const std::int16_t> clip,
                 std::span<const std::uint8_t> marks, std::span<std::int16_t> out) {
  SONAR_CHECK(excess.size() == out.size() && clip.size() == out.size() && marks.size() == out.size());
  HWY_DYNAMIC_DISPATCH(ClipExcess)(excess.data(), clip.data(), marks.data(), out.data(), out.size());
}

void take_off_steps(std::span<const std::int8_t> steps, std::int16_t step, std::span<std::int16_t> excess) {
  SONAR_CHECK(steps.size() == excess.size());
  HWY_DYNAMIC_DISPATCH(TakeOffSteps)(steps.data(), step, excess.data(), excess.size());
}

void whiten(std::span<const std::int16_t> excess, std::span<const float> middle, std::span<const float> scale,
            std::span<float> whitened, std::span<float> number) {
  SONAR_CHECK(middle.size() == excess.size() && scale.size() == excess.size() && whitened.size() == excess.size() &&
              number.size() == excess.size());
  HWY_DYNAMIC_DISPATCH(Whiten)
  (excess.data(), middle.data(), scale.data(), whitened.data(), number.data(), excess.size());
}

void over_root(std::span<const std::int16_t> excess, std::span<const float> sum, std::span<const float> number,
               std::span<std::int16_t> out) {
  SONAR_CHECK(excess.size() == out.size() && sum.size() == out.size() && number.size() == out.size());
  HWY_DYNAMIC_DISPATCH(OverRoot)(excess.data(), sum.data(), number.data(), out.data(), out.size());
}

void rounded_steps(std::span<const float> sum, std::span<const float> number, float least, std::int16_t step,
                   std::span<std::int8_t> out) {
  SONAR_CHECK(least > 0.0F && sum.size() == out.size() && number.size() == out.size());
  HWY_DYNAMIC_DISPATCH(RoundedSteps)
  (sum.data(), number.data(), least, static_cast<float>(step), out.data(), out.size());
}

}  // namespace sonar
#endif  // HWY_ONCE
