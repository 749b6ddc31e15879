# SPDX-License-Identifier: Apache-2.0
# Before CPack packs what it has put together: with SOURCE_DATE_EPOCH every file bears that time, so that the same source
# gives the same package.
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  execute_process(COMMAND find ${CPACK_TEMPORARY_DIRECTORY} -exec touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} {} +
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
