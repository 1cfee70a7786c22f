#pragma once
// orthonormal bases of null functionals of order >= p over stages {1,6..13,14}
#include "erkp.h"
namespace nul {
struct Tree { std::vector<Tree> children; int order = 1; };
inline void forests(const std::vector<Tree>& pool, size_t first, int order, std::vector<Tree>& chosen, const std::function<void(const std::vector<Tree>&)>& visit) {
  if (order == 0) return visit(chosen);
  for (size_t i = first; i < pool.size(); ++i) { if (pool[i].order > order) continue; chosen.push_back(pool[i]); forests(pool, i, order - pool[i].order, chosen, visit); chosen.pop_back(); } }
inline std::vector<Tree> trees_up_to(int order) { std::vector<Tree> all{Tree{}};
  for (int k = 2; k <= order; ++k) { const auto smaller = all; std::vector<Tree> chosen; forests(smaller, 0, k - 1, chosen, [&](const std::vector<Tree>& c) { all.push_back({c, k}); }); } return all; }
inline double A(int i,int j){ if(j>12) return 0; return i<13?verner87.a[i][j]:verner87.b[j]; }
inline std::array<double,14> sw(const Tree& t) { std::array<double,14> phi; phi.fill(1); for (auto& c : t.children) { auto b = sw(c); for (int i=0;i<14;++i){double s=0; for(int j=0;j<14;++j) s+=A(i,j)*b[j]; phi[i]*=s;} } return phi; }
// columns: functionals on 14 stages, satisfying all conditions of order <= p, orthogonal to those of `above`
inline std::vector<std::array<double,14>> basis(int p, bool end){ auto ts=trees_up_to(p); std::vector<int> st; for(int i=0;i<(end?14:13);++i) if(!(i>=1&&i<=4)) st.push_back(i);
  Eigen::MatrixXd M(ts.size(),st.size()); for(size_t r=0;r<ts.size();++r){auto phi=sw(ts[r]); for(size_t c=0;c<st.size();++c) M(r,c)=phi[st[c]];}
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(M,Eigen::ComputeFullV); int rank=0; for(int i=0;i<svd.singularValues().size();++i) if(svd.singularValues()[i]>1e-12*svd.singularValues()[0]) ++rank;
  std::vector<std::array<double,14>> out; for(int c=rank;c<(int)st.size();++c){ std::array<double,14> w{}; for(size_t r=0;r<st.size();++r) w[st[r]]=svd.matrixV()(r,c); out.push_back(w);} return out; }
// those of exact order p: in null(p), orthogonal to null(p+1)
inline std::vector<std::array<double,14>> exact(int p, bool end){ auto lo=basis(p,end), hi=basis(p+1,end); std::vector<std::array<double,14>> out; std::vector<std::array<double,14>> q=hi; for(auto w:lo){ for(auto&u:q){double s=0; for(int i=0;i<14;++i)s+=u[i]*w[i]; for(int i=0;i<14;++i)w[i]-=s*u[i];} double m=0; for(double x:w)m+=x*x; m=std::sqrt(m); if(m<1e-6) continue; for(double&x:w)x/=m; q.push_back(w); out.push_back(w);} return out; }
}
