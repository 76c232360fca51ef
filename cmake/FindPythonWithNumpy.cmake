# Sets Python_EXECUTABLE to the first Python 3 that has numpy and its own headers: the active virtual environment, then
# python3 on PATH, then python3 of the system's standard folders. A python3 without numpy that comes first on PATH (pyenv,
# conda) is passed over; CMake's own search would stop at it.
if(NOT DEFINED Python_EXECUTABLE)
  execute_process(COMMAND getconf PATH OUTPUT_VARIABLE standard_path OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE ":" ";" standard_path "${standard_path}")
  set(candidates "")
  if(DEFINED ENV{VIRTUAL_ENV})
    list(APPEND candidates "$ENV{VIRTUAL_ENV}/bin/python3")
  endif()
  find_program(python3_on_path python3 NO_CACHE)
  list(APPEND candidates ${python3_on_path})
  foreach(folder IN LISTS standard_path)
    list(APPEND candidates "${folder}/python3")
  endforeach()
  foreach(candidate IN LISTS candidates)
    execute_process(
      COMMAND "${candidate}" -c
              "import numpy, os, sysconfig; assert os.path.exists(sysconfig.get_path('include') + '/Python.h')"
      RESULT_VARIABLE failed
      OUTPUT_QUIET ERROR_QUIET)
    if(NOT failed)
      set(Python_EXECUTABLE "${candidate}" CACHE FILEPATH "Python 3 with numpy and headers")
      break()
    endif()
  endforeach()
endif()
