// SPDX-License-Identifier: Apache-2.0
#include "io/gdal_drivers.h"

#include <cpl_conv.h>
#include <gdal_frmts.h>
#include <ogrsf_frmts.h>

#include <mutex>

namespace sonar {

void begin_gdal() {
  static std::once_flag once;
  std::call_once(once, [] {
    CPLSetConfigOption("GDAL_PAM_ENABLED", "NO");
    CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
    CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_EXTENSIONS", ".none");
    CPLSetConfigOption("GDAL_NUM_THREADS", "1");
    GDALRegister_GTiff();
    GDALRegister_netCDF();
    GDALRegister_AAIGrid();
    RegisterOGRGeoPackage();
  });
}

}  // namespace sonar
