# Completion of hrad for bash: commands, their options, parameter names and the words they take.
# A test compares the lists with `hrad --help`, `hrad COMMAND --help` and `hrad params`.

_hrad_commands='solve export render query info check partition scene machine params'
_hrad_run_options='--help --accuracy --threads --set --two-sided --flip --mpi --quiet --verbose'
_hrad_params='bands accuracy linking detail oracle bf_epsilon min_area tolerance max_iterations refine seed
  unit visibility sides threads smt bind partition max_memory resumable checkpoint_keep up
  instruction_set'

_hrad_options() {  # of a command
  case $1 in
    solve)
      echo "$_hrad_run_options --output --json --checkpoint --checkpoint-interval" \
        "--checkpoint-keep --restart --time-limit" ;;
    export) echo "$_hrad_run_options --output" ;;
    render)
      echo "$_hrad_run_options --output --size --eye --look --up --fov --exposure --false-colour" \
        "--quantity --range --mesh --json" ;;
    query)
      echo "$_hrad_run_options --patches --at --sensors --grid --quantity --output --json --csv" ;;
    info | machine) echo "$_hrad_run_options --json" ;;
    partition) echo "$_hrad_run_options --ranks --method --output --json" ;;
    check) echo '--help' ;;
    scene) echo '--help --output --list' ;;
    params) echo '--help --json' ;;
    *) echo '--help --version' ;;
  esac
}

_hrad_words() {  # those of the list $1 that begin with $2
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$2")
}

_hrad_files() {  # directories, and files whose ending is in the pattern $1, that begin with $2
  local files
  mapfile -t files < <(compgen -f -- "$2" | grep -E "\.($1)\$")
  mapfile -t COMPREPLY < <(compgen -d -S / -- "$2")
  COMPREPLY+=("${files[@]}")
  compopt -o nospace 2>/dev/null
}

_hrad() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    _hrad_words "$_hrad_commands --help --version" "$word"
    return
  fi
  case $previous in
    --set)
      # shellcheck disable=SC2086  # one word a parameter
      _hrad_words "$(printf '%s= ' $_hrad_params)" "$word"
      compopt -o nospace 2>/dev/null
      return
      ;;
    --method) _hrad_words 'cost grid' "$word"; return ;;
    --mpi) _hrad_words 'on off auto' "$word"; return ;;
    --quantity) _hrad_words 'radiosity irradiance emission net_flux' "$word"; return ;;
    --sensors) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;
    -o | --output)
      case $command in
        scene) _hrad_files 'obj' "$word" ;;
        render | query) _hrad_files 'png' "$word" ;;
        partition) _hrad_files 'vtu' "$word" ;;
        *) _hrad_files 'hrad|csv|vtu|ply|glb|png' "$word" ;;
      esac
      return
      ;;
    --checkpoint) _hrad_files 'hrad' "$word"; return ;;
    --restart)
      _hrad_files 'hrad' "$word"
      [[ auto == "$word"* ]] && COMPREPLY+=(auto)
      return
      ;;
    --accuracy | --checkpoint-interval | --checkpoint-keep | --time-limit | --threads | -n | --ranks | \
      --at | --grid | --size | --eye | --look | --up | --fov | --exposure | \
      --range) return ;;
  esac
  if [[ $word == -* ]]; then
    _hrad_words "$(_hrad_options "$command")" "$word"
    return
  fi
  case $command in
    solve | export | render | query | info | partition)
      _hrad_files 'obj|hrad' "$word"
      local files=("${COMPREPLY[@]}")
      _hrad_words "$(hrad scene --list 2>/dev/null)" "$word"
      if ((${#files[@]} == 0)); then compopt +o nospace 2>/dev/null; fi
      COMPREPLY+=("${files[@]}")
      ;;
    check) _hrad_files 'hrad' "$word" ;;
    scene) _hrad_words "$(hrad scene --list 2>/dev/null)" "$word" ;;
  esac
}
complete -F _hrad hrad
