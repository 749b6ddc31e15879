// SPDX-License-Identifier: Apache-2.0
#include "itk_median.h"

#include <itkFlatStructuringElement.h>
#include <itkImage.h>
#include <itkImportImageFilter.h>
#include <itkMedianImageFilter.h>
#include <itkMultiThreaderBase.h>
#include <itkRankImageFilter.h>

#include <algorithm>

namespace sonar::bench {

namespace {

using Image = itk::Image<std::int16_t, 3>;

Image::Pointer image_of(View3<const std::int16_t> ping) {
  const Shape3 shape = ping.shape();
  const auto image = Image::New();
  Image::RegionType region;
  region.SetSize({{static_cast<itk::SizeValueType>(shape.samples), static_cast<itk::SizeValueType>(shape.beams),
                   static_cast<itk::SizeValueType>(shape.fans)}});
  image->SetRegions(region);
  image->Allocate();
  std::copy(ping.all().begin(), ping.all().end(), image->GetBufferPointer());
  return image;
}

template <class Filter>
Array3<std::int16_t> run(Filter& filter, View3<const std::int16_t> ping, int threads) {
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(static_cast<itk::ThreadIdType>(threads));
  filter.SetInput(image_of(ping));
  filter.SetNumberOfWorkUnits(static_cast<itk::ThreadIdType>(threads));
  filter.Update();
  Array3<std::int16_t> out(ping.shape());
  std::copy_n(filter.GetOutput()->GetBufferPointer(), out.all().size(), out.all().begin());
  return out;
}

}  // namespace

Array3<std::int16_t> itk_median(View3<const std::int16_t> ping, int threads) {
  const auto filter = itk::MedianImageFilter<Image, Image>::New();
  filter->SetRadius({{11, 1, 1}});
  return run(*filter, ping, threads);
}

Array3<std::int16_t> itk_rank(View3<const std::int16_t> ping, int threads) {
  using Kernel = itk::FlatStructuringElement<3>;
  const auto filter = itk::RankImageFilter<Image, Image, Kernel>::New();
  filter->SetKernel(Kernel::Box({{11, 1, 1}}));
  filter->SetRank(0.5);
  return run(*filter, ping, threads);
}

}  // namespace sonar::bench
