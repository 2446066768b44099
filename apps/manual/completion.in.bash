# Completion of dmpc in bash, written from the declarations of its options.
# Sets words, files, endings (of files), folders and is_list to what may stand for an argument or, if there is a $2, for the value of this option of
# command $1.
_dmpc_value() {
  words="" files="" endings="" folders="" is_list=""
  case "$1:$2" in
@values@  esac
}

# Sets commands, options and valued, the options with a value, to those of command $1.
_dmpc_declared() {
  commands="" options="" valued=""
  case "$1" in
@declarations@  esac
}

# Prints the files that go on from $1, with $2 before them: folders, and what has one of the endings set, if any are.
_dmpc_files() {
  compgen -P "$2" -d -- "$1"
  compgen -P "$2" -f -- "$1" | while read -r file; do
    local ending=${file##*.}
    [[ ${ending,,} != gz ]] || ending=${file%.*} ending=${ending##*.}.gz
    [[ -d ${file#"$2"} || " $endings " != *" ${ending,,} "* ]] || echo "$file"
  done
}

# Completes $1 from the words, files and folders set; $2 stands before what bash is to put in place.
_dmpc_offer() {
  local typed=$1 before=$2 last=$1
  if [[ $typed == *:* && " $words " == *" ${typed%%:*}: "* ]]; then  # behind such a word there is a file
    before+=${typed%%:*}:
    [[ $COMP_WORDBREAKS == *:* ]] && before=""
    last=${typed#*:} words="" files=1
  fi
  if [[ -n $is_list ]]; then
    last=${typed##*,}
    before+=${typed%"$last"}
  fi
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$words" -- "$last")
  local found=()
  [[ -n $files && -z $endings ]] && mapfile -t found < <(compgen -P "$before" -f -- "$last")
  [[ -n $files && -n $endings ]] && mapfile -t found < <(_dmpc_files "$last" "$before")
  [[ -n $folders ]] && mapfile -t found < <(compgen -P "$before" -d -- "$last")
  if ((${#found[@]})); then
    COMPREPLY+=("${found[@]}")
    compopt -o filenames 2>/dev/null
  fi
  [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}

_dmpc() {
  COMPREPLY=()
  local line=() word n
  for ((n = 1; n <= COMP_CWORD; n++)); do  # bash cuts --option=value into three words, and at colons
    word=${COMP_WORDS[n]}
    if ((${#line[@]})) && [[ ($word == = && ${line[-1]} == --*) || (${COMP_WORDS[n - 1]} == = && ${line[-1]} == --*=) ||
      ($word == : && ${line[-1]} == --*=*) || (${COMP_WORDS[n - 1]} == : && ${line[-1]} == --*=*:) ]]; then
      line[-1]+=$word
    else
      line+=("$word")
    fi
  done
  local current=${line[-1]} command="" previous="" commands options valued words files endings folders is_list
  _dmpc_declared ""
  for word in "${line[@]:0:${#line[@]}-1}"; do
    if [[ " $commands " == *" $word "* ]]; then
      command+=${command:+ }$word
      _dmpc_declared "$command"
    fi
    previous=$word
  done
  if [[ $current == --*=* ]]; then
    local before=""
    [[ $COMP_WORDBREAKS == *=* ]] || before=${current%%=*}=
    _dmpc_value "$command" "${current%%=*}"
    _dmpc_offer "${current#*=}" "$before"
  elif [[ -n $previous && " $valued " == *" $previous "* ]]; then
    _dmpc_value "$command" "$previous"
    _dmpc_offer "$current" ""
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
    [[ ${#COMPREPLY[@]} == 1 && ${COMPREPLY[0]} == *= ]] && compopt -o nospace 2>/dev/null
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
  else
    _dmpc_value "$command" ""
    _dmpc_offer "$current" ""
  fi
  return 0
}

complete -F _dmpc dmpc
