! The constants of hrad.h under their C names: version, statuses, enumerations. All are of the kind
! c_int32_t, which is default integer unless a compiler option changes that.
module hrad_constants
  use, intrinsic :: iso_c_binding, only: c_int32_t
  implicit none
  public
  private :: c_int32_t

  ! The version of hrad.h for which this binding was written; hrad_version() is that of the library.
  integer(c_int32_t), parameter :: HRAD_VERSION_MAJOR = 0
  integer(c_int32_t), parameter :: HRAD_VERSION_MINOR = 1
  integer(c_int32_t), parameter :: HRAD_VERSION_PATCH = 0

  ! Status: 0 done, positive a normal event, negative an error.
  integer(c_int32_t), parameter :: HRAD_OK = 0
  integer(c_int32_t), parameter :: HRAD_NOT_CONVERGED = 1      ! usable, the accuracy isn't promised
  integer(c_int32_t), parameter :: HRAD_STOPPED = 2            ! by hrad_request_stop or a callback
  integer(c_int32_t), parameter :: HRAD_ERROR_ARGUMENT = -1    ! also a wrong shape or index
  integer(c_int32_t), parameter :: HRAD_ERROR_STATE = -2       ! a call out of order
  integer(c_int32_t), parameter :: HRAD_ERROR_MEMORY = -3      ! out of memory, or over max_memory
  integer(c_int32_t), parameter :: HRAD_ERROR_FILE = -4        ! can't be opened, read or written
  integer(c_int32_t), parameter :: HRAD_ERROR_FORMAT = -5      ! a file's content is wrong
  integer(c_int32_t), parameter :: HRAD_ERROR_SCENE = -6       ! a scene is invalid
  integer(c_int32_t), parameter :: HRAD_ERROR_MPI = -7         ! a communication failed
  integer(c_int32_t), parameter :: HRAD_ERROR_UNSUPPORTED = -8 ! not in this build or version
  integer(c_int32_t), parameter :: HRAD_ERROR_INTERNAL = -9    ! a fault of the library

  ! Levels of messages, for hrad_set_log.
  integer(c_int32_t), parameter :: HRAD_LOG_ERROR = 0
  integer(c_int32_t), parameter :: HRAD_LOG_WARNING = 1
  integer(c_int32_t), parameter :: HRAD_LOG_INFO = 2
  integer(c_int32_t), parameter :: HRAD_LOG_DEBUG = 3

  ! Types of parameters: hrad_param%type.
  integer(c_int32_t), parameter :: HRAD_PARAM_INT = 0
  integer(c_int32_t), parameter :: HRAD_PARAM_DOUBLE = 1
  integer(c_int32_t), parameter :: HRAD_PARAM_TEXT = 2

  ! Flags of materials; combine them by addition or ior().
  integer(c_int32_t), parameter :: HRAD_TWO_SIDED = 1
  integer(c_int32_t), parameter :: HRAD_BLOCKER = 2

  ! Flags of patches: hrad_patch%flags; ask with iand().
  integer(c_int32_t), parameter :: HRAD_PATCH_DROPPED = 1
  integer(c_int32_t), parameter :: HRAD_PATCH_TWO_SIDED = 2
  integer(c_int32_t), parameter :: HRAD_PATCH_BLOCKER = 4

  ! The most ranks that hrad_plan_partition plans for.
  integer(c_int32_t), parameter :: HRAD_MOST_RANKS = 65536

  ! Quantities and sides of the queries.
  integer(c_int32_t), parameter :: HRAD_RADIOSITY = 0
  integer(c_int32_t), parameter :: HRAD_IRRADIANCE = 1
  integer(c_int32_t), parameter :: HRAD_EMISSION = 2
  integer(c_int32_t), parameter :: HRAD_NET_FLUX = 3
  integer(c_int32_t), parameter :: HRAD_FRONT = 0
  integer(c_int32_t), parameter :: HRAD_BACK = 1
end module hrad_constants
