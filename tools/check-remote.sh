#!/bin/sh
# A sweep in a folder by daemons on another host, through SSH and back by TLS: the other host is
# this one, by an sshd of its own with keys of its own in a scratch folder. The same bits as in one
# process; also where daemons come late and one is killed. No file of the user's is read or written.
. "${0%/*}/common.sh"

sshd=$(command -v sshd || ls /usr/sbin/sshd /usr/local/sbin/sshd 2> /dev/null | head -1)
for program in "${sshd:-sshd}" ssh ssh-keygen; do
  command -v "$program" > /dev/null ||
    { echo "skipped: $program is needed (Debian: apt-get install openssh-server)"; exit 0; }
done
test -d /proc/self || { echo "skipped: the processes are followed by /proc"; exit 0; }
for package in mirai nanoparquet yyjsonr; do
  Rscript -e "quit(status = !requireNamespace('$package', quietly = TRUE))" > /dev/null 2>&1 ||
    { echo "skipped: the package $package is needed"; exit 0; }
done

# An sshd of root wants this empty folder, which the system makes when its own sshd starts.
own_chroot=""
server=""
ROTDYN_KILL_STATE=$work/state
export ROTDYN_KILL_STATE
end_all() {
  sh tools/end-processes.sh "$ROTDYN_KILL_STATE"
  test -z "$server" || kill "$server" 2> /dev/null
  test -z "$own_chroot" || rmdir /run/sshd 2> /dev/null
}
trap 'end_all; rm -rf "$work"' 0
if test "$(id -u)" = 0 && test ! -d /run/sshd; then
  mkdir -m 755 /run/sshd 2> /dev/null || { echo "skipped: sshd needs /run/sshd"; exit 0; }
  own_chroot=yes
fi

mkdir "$work/library"
{ build_tarball "$work" --no-build-vignettes && install_into "$work/library"; } \
  > "$work/log" 2>&1 || { cat "$work/log"; exit 1; }
R_LIBS="$work/library:$R_LIBS"
export R_LIBS

mkdir "$work/state" "$work/state/pids"
ssh-keygen -q -t ed25519 -N "" -f "$work/host_key" &&
  ssh-keygen -q -t ed25519 -N "" -f "$work/user_key" || exit 1
# A port that another program has is not taken: the next one is tried.
port=$((20000 + $$ % 20000))
tries=0
while :; do
  cat > "$work/sshd_config" << EOF
Port $port
ListenAddress 127.0.0.1
HostKey $work/host_key
AuthorizedKeysFile $work/user_key.pub
PidFile none
UsePAM no
StrictModes no
PasswordAuthentication no
KbdInteractiveAuthentication no
PermitRootLogin prohibit-password
SetEnv R_LIBS=$R_LIBS ROTDYN_KILL_STATE=$work/state R_PROFILE_USER=$top/tools/kill-sweep-profile.R
EOF
  echo "[127.0.0.1]:$port $(cut -d ' ' -f 1,2 "$work/host_key.pub")" > "$work/known_hosts"
  cat > "$work/ssh_config" << EOF
IdentityFile $work/user_key
IdentitiesOnly yes
IdentityAgent none
BatchMode yes
UserKnownHostsFile $work/known_hosts
GlobalKnownHostsFile /dev/null
StrictHostKeyChecking yes
EOF
  "$sshd" -D -e -f "$work/sshd_config" 2> "$work/sshd.log" &
  server=$!
  waited=0
  while kill -0 $server 2> /dev/null && test $waited -lt 100 &&
    ! grep -q "^Server listening" "$work/sshd.log"; do sleep 0.1; waited=$((waited + 1)); done
  if grep -q "^Server listening" "$work/sshd.log" && kill -0 $server 2> /dev/null; then break; fi
  kill $server 2> /dev/null
  tries=$((tries + 1))
  port=$((port + 1))
  test $tries -lt 5 || { cat "$work/sshd.log"; echo "not ok - no sshd starts"; exit 1; }
done

printf '#!/bin/sh\nexec ssh -F %s/ssh_config "$@"\n' "$work" > "$work/ssh"
chmod +x "$work/ssh"
# An account that is locked takes no key: that is no fault of a sweep.
if ! "$work/ssh" -T -p "$port" 127.0.0.1 true > "$work/ssh.log" 2>&1 < /dev/null; then
  cat "$work/ssh.log"
  grep -q "account is locked" "$work/sshd.log" &&
    { echo "skipped: this account takes no SSH login"; exit 0; }
  cat "$work/sshd.log"
  echo "not ok - no login through sshd"
  exit 1
fi

Rscript tools/check-remote.R "$work" "$port"
status=$?
test $status = 0 || cat "$work/sshd.log"
exit $status
