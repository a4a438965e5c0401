# Completion of brume's arguments in bash. What there is to complete is asked of the program itself, so that this file
# does not know it a second time.

# The long options of a command: _brume_options PROGRAM [COMMAND]
_brume_options() { "$@" --help 2> /dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u; }

# The kinds of volumes, or the parameters of one: _brume_volumes PROGRAM [KIND]
_brume_volumes() {
  "$1" make --help 2> /dev/null | awk -v kind="${2-}" '
    /^  [a-z_]+  +/ { current = $1; if (kind == "") print $1 }
    /^         [a-z]/ && current == kind { print $1 "=" }'
}

# The phase functions, or the parameters of one: _brume_phases PROGRAM [NAME]
_brume_phases() {
  "$1" phase 2> /dev/null | awk -v name="${2-}" '
    /^[a-z_]+: / { current = substr($1, 1, length($1) - 1); if (name == "") print current }
    /^    [a-z]/ && current == name { print $1 "=" }'
}

# Completes to the given words; after those that end in =, a value follows without a space.
_brume_words() {
  mapfile -t COMPREPLY < <(compgen -W "$*" -- "$current")
  if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace 2> /dev/null; fi
}

# Completes to folders and to files of the given suffixes, or to all files: _brume_files [SUFFIX|SUFFIX...]
_brume_files() {
  local pattern='*'
  if [[ -n ${1-} ]]; then pattern="*.@($1)"; fi
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(
    shopt -s extglob
    compgen -d -- "$current"
    compgen -f -X "!$pattern" -- "$current" | while IFS= read -r file; do [[ -d $file ]] || printf '%s\n' "$file"; done
  )
}

_brume() {
  local program=${COMP_WORDS[0]} current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=
  COMPREPLY=()
  if ((COMP_CWORD > 1)) && [[ ${COMP_WORDS[1]} =~ ^(bench|compare|info|make|phase|render)$ ]]; then
    command=${COMP_WORDS[1]}
  fi
  # bash takes = for a word of its own: what follows it is a number, which nobody can guess.
  if [[ $current == '=' || $previous == '=' ]]; then return; fi
  case $previous in
    -o | --output | --write-scene | --stats-json) _brume_files && return ;;
    --integrator) _brume_words classic reference volpath && return ;;
    --set) _brume_words "$(_brume_volumes "$program" "${COMP_WORDS[2]-}")" && return ;;
    --spp | --time | --seed | --nthreads | --resolution | --cropwindow | --pixelbounds | --exposure | --grid | --size | --sparse | --block | --step) return ;;
  esac
  if [[ $current == -* ]]; then
    _brume_words "$(_brume_options "$program" "${command:-render}")"
    return
  fi
  case $command in
    make) if ((COMP_CWORD == 2)); then _brume_words "$(_brume_volumes "$program")"; fi ;;
    phase)
      if ((COMP_CWORD == 2)); then
        _brume_words "$(_brume_phases "$program")"
      else
        _brume_words "$(_brume_phases "$program" "${COMP_WORDS[2]}")"
      fi
      ;;
    compare) _brume_files 'exr|pfm' ;;
    info) _brume_files 'pbrt|pbrt.gz|vdb|nvdb|vol|exr|pfm' ;;
    bench) ;;
    *)
      _brume_files 'pbrt|pbrt.gz|vdb|nvdb|vol'
      if ((COMP_CWORD == 1)); then
        mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -W 'bench compare info make phase render' -- "$current")
      fi
      ;;
  esac
}

complete -F _brume brume
