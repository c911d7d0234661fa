#!/usr/bin/env bash
# Several nodes on one machine, by loopback alone: each with a host name of its own, a daemon of mpirun
# of its own that no ssh has started, and processors of its own as hwloc tells them. Their processes
# have pools of different sizes, only those of one node share processors, and the bits are those of one
# process.
# shellcheck source=tests/mpi/common.sh
. "$HRAD_SOURCE_DIR/tests/mpi/common.sh"

own=(unshare --uts)
"${own[@]}" true 2>/dev/null || own=(unshare --user --map-root-user --uts)
"${own[@]}" sh -c 'hostname another' 2>/dev/null || {
  echo "skipped: this process may not have a host name of its own"
  exit 77
}

# As ssh would be called: AGENT NODE COMMAND. The node of the paper, one that tells nothing of packages,
# and one that two processes share.
cat >agent <<END
#!/bin/sh
node=\$1
shift
case \$node in
  paper) HWLOC_SYNTHETIC='pack:2 [numa] l3:1 core:4 pu:2' ;;
  plain) HWLOC_SYNTHETIC='core:2 pu:1' ;;
  shared) HWLOC_SYNTHETIC='pack:1 core:4 pu:1' ;;
esac
export HWLOC_SYNTHETIC
exec ${own[*]} sh -c 'hostname "\$0" && exec sh -c "\$*"' \$node "\$@"
END
chmod +x agent
unset OMPI_MCA_plm
export OMPI_MCA_plm_rsh_agent=$work/agent OMPI_MCA_btl=tcp,vader,self OMPI_MCA_btl_tcp_if_include=lo \
  OMPI_MCA_oob_tcp_if_include=lo
nodes=(--host 'paper:1,plain:1,shared:2')

# Other launchers, and other versions of this one, know their agents by other names.
timeout 60 mpirun "${nodes[@]}" -n 4 hostname >names 2>said
[ "$(sort names | tr '\n' ' ')" = 'paper plain shared shared ' ] || {
  echo "skipped: this mpirun doesn't start nodes by an agent on the loopback interface: $(head -2 said)"
  exit 77
}

says() { grep -qF -- "$1" err || complain "$ran: stderr lacks '$1': $(cat err)"; }
well() { [ "$code" = 0 ] || complain "$ran: exit code $code: $(cat err)"; }

# By clusters too, whose messages are others.
for method in rows clusters; do
  scene=(cornell --accuracy 0.1 --set "linking=$method")
  "$HRAD" solve "${scene[@]}" --threads 1 --quiet -o alone.hrad </dev/null >/dev/null
  wanted=$(hash_of "${scene[@]}")
  launch 4 solve "${scene[@]}" --json -v -o together.hrad
  ends
  well
  holds "j['state_hash'] == '$wanted' and j['ranks'] == 4 and j['threads'] == 8"
  says 'process 0 on node paper: 8 threads (one thread for each of 8 usable cores)'
  says 'process 1 on node plain: 2 threads (one thread for each of 2 usable cores)'
  for rank in 2 3; do
    says "process $rank on node shared: 2 threads (one thread for each of 4 usable cores; 2 processes share"
  done
  grep 'warning: .* processors' err && complain "$ran: a warning though nobody fights for processors"
  cmp -s alone.hrad together.hrad || complain "$ran: another file than that of one process"
done

# By contexts, where cores have two.
launch 4 solve cornell --accuracy 0.2 --json -v --set smt=1
ends
well
says 'process 0 on node paper: 16 threads'
says 'process 3 on node shared: 2 threads'

# More threads than one of the nodes has processors for: it is named, with what helps, and no other.
launch 4 solve cornell --accuracy 0.2 --json --threads 3
ends
well
says 'warning: 2 processes on node shared would run 6 threads on the same 4 processors'
says 'mpirun --map-by slot:PE=3'
[ "$(grep -c 'warning: .* processors' err)" = 1 ] || complain "$ran: not one warning: $(cat err)"

# What one node does to its process ends the job on all.
for victim in 1 3; do
  launch 4 solve cornell --accuracy 0.01 --set linking=pairs --threads 1 -v -o result.csv
  until_said 'stage refine'
  kill -s KILL "$(cat process.$victim)" 2>/dev/null || complain "$ran: over before it was killed"
  ends
  [ "$code" != 0 ] || complain "$ran: exit code 0 though process $victim was killed"
  [ "$code" != 124 ] || complain "$ran: hangs when process $victim is killed"
  [ -e result.csv ] && complain "$ran: a result was written"
done
finish
